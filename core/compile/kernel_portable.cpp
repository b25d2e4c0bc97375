#include "core/compile/kernel.h"

#define FOCALSTAGE_LANES 4
#define FOCALSTAGE_KERNEL portable_kernel
#include "core/compile/kernel.inl"
