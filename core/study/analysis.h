#pragma once

#include <optional>
#include <vector>

#include "core/study/anova.h"
#include "core/study/cells.h"
#include "core/study/regression.h"

namespace focalstage {

/// Of some means: how many, their mean, and their standard deviation (n - 1; 0 of one).
struct Spread {
  int count = 0;
  double mean_m = 0.0;
  double deviation_m = 0.0;
};

/// One condition at one target, or (target -1) at all of them.
struct ErrorSummary {
  int condition = 0;
  int target = -1;
  Spread estimated;
  Spread error;
};

/// The difference of two conditions within each participant: what the paper's tests, which count all means as
/// independent, leave unused.
struct Within {
  int first = 0;
  int second = 0;
  int participants = 0;
  double difference_m = 0.0;  ///< mean over participants of (mean error under first - under second)
  double low_m = 0.0;         ///< 95 % confidence
  double high_m = 0.0;
  double t = 0.0;
  double df = 0.0;
  double p = 1.0;
};

/// Everything a report says of the answers.
struct StudyAnalysis {
  CellMeans cells;
  std::vector<ErrorSummary> by_target;  ///< condition by condition
  std::vector<ErrorSummary> by_condition;
  std::optional<Regression> regression;
  std::optional<Anova> anova;
  std::vector<Within> within;  ///< pairs with at least two whole participants whose differences vary
};

StudyAnalysis analyse(const Study& study, const std::vector<Response>& responses);

}  // namespace focalstage
