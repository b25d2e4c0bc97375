#pragma once

#include "core/compile/kernel.h"
#include "core/compile/stack_plan.h"
#include "core/compile/stack_solver.h"

namespace focalstage {

/// For tile `slot`: what the slices of `light` look like at each focus, added to `seen` [focus][64] with a sign.
void see_tile(const Kernel& kernel, const StackPlan& plan, const StackField& light, std::size_t slot, float sign,
              float* seen);

/// The transpose: which pixels of each slice the cells of `cells` [tile][focus] take light from, into `light`
/// [slice][64].
void trace_back_tile(const Kernel& kernel, const StackPlan& plan, const StackField& cells, std::size_t slot,
                     float* light);

}  // namespace focalstage
