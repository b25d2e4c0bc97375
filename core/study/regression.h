#pragma once

#include <optional>
#include <vector>

#include "core/study/cells.h"
#include "core/study/least_squares.h"

namespace focalstage {

/// estimated = slope * actual + intercept, over the means of one condition.
struct FittedLine {
  int condition = 0;
  double slope = 0.0;
  double intercept_m = 0.0;
  double r_squared = 0.0;  ///< 1 where all means lie on the line, also where none varies
  int points = 0;
};

/// The paper's comparison of conditions by multiple regression (after Swan et al. 2015): do their lines differ in
/// slope, and where they are given one slope, in intercept?
struct Regression {
  std::vector<FittedLine> lines;   ///< each condition by itself
  std::vector<double> parallel_m;  ///< intercepts under the common slope, per condition
  double common_slope = 0.0;
  std::optional<FTest> slopes;      ///< F(k-1, N-2k): N means, k conditions
  std::optional<FTest> intercepts;  ///< F(k-1, N-k-1)
};

/// Nothing where a condition has means at fewer than two distances. A test is missing where answers vary by nothing
/// but what the lines explain, or are too few.
std::optional<Regression> regression_of(const Study& study, const CellMeans& cells);

}  // namespace focalstage
