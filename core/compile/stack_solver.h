#pragma once

#include <stop_token>
#include <vector>

#include "core/compile/kernel.h"
#include "core/compile/stack_plan.h"

namespace focalstage {

/// Values of a plan's tiles: [tile][layer][64], a layer being a slice or a focus.
using StackField = std::vector<float>;

/// One channel of one eye.
struct StackProblem {
  StackField linear;  ///< [tile][slice]: what linear filtering shows, at most 1
  StackField most;    ///< [tile][slice]: the most that may be shown
  StackField target;  ///< [tile][focus]: what should be seen; counts in asked cells
};

struct StackError {
  double sum = 0.0;  ///< of squares
  std::size_t count = 0;
};

struct StackSolution {
  StackField change;  ///< [tile][slice], to be added to `linear`; zero where nothing may change
  StackError linear;  ///< over the asked cells and all focuses
  StackError optimal;
  std::size_t accepted_tiles = 0;  ///< asked tiles of islands where the error fell
};

/// Fits the stack by non-negative least squares with bounds: accelerated projected gradients (Beck and Teboulle 2009,
/// with the restart of O'Donoghue and Candes 2015) from the linear images, for a number of rounds that depends on the
/// amount of work alone. Islands of tiles whose error did not fall stay linear. Unfinished after a stop request.
StackSolution solve_stack(const StackPlan& plan, const StackProblem& problem, const Kernel& kernel,
                          std::stop_token stop);

}  // namespace focalstage
