#include "core/compile/kernel.h"

#define FOCALSTAGE_LANES 8
#define FOCALSTAGE_KERNEL avx2_kernel
#include "core/compile/kernel.inl"
