#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace focalstage {

/// Rows of numbers, one after another.
struct Rows {
  std::size_t width = 0;
  std::vector<double> numbers;

  std::size_t count() const { return width == 0 ? 0 : numbers.size() / width; }
  std::span<const double> operator[](std::size_t row) const { return {numbers.data() + row * width, width}; }

  /// A new row of zeros, to be filled in.
  std::span<double> add();
};

/// The least of cost . x + (1/2) sum ridge_i x_i^2 where at_most x <= most and equal x = exactly. All rows are as wide
/// as there are costs; ridges are not negative.
struct LinearProgram {
  std::vector<double> cost;
  std::vector<double> ridge;
  Rows at_most;
  std::vector<double> most;
  Rows equal;
  std::vector<double> exactly;
};

/// The x of the least cost; nothing where none fulfils the rows, or none was found within `most_steps`.
///
/// Mehrotra's predictor-corrector (S. Mehrotra, On the implementation of a primal-dual interior point method, SIAM
/// J. Optim. 2(4), 1992) with dense normal equations: right for tens of unknowns and up to some thousand rows. At most
/// `most_steps` steps of (rows + unknowns) unknowns^2 operations; the same x on every machine and at any load.
std::optional<std::vector<double>> least_cost(const LinearProgram& program, int most_steps = 60);

}  // namespace focalstage
