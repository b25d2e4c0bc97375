#include "core/compile/kernel.h"

namespace focalstage {

const Kernel& best_kernel() { return __builtin_cpu_supports("avx2") ? avx2_kernel : portable_kernel; }

}  // namespace focalstage
