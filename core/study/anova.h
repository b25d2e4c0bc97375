#pragma once

#include <optional>
#include <vector>

#include "core/study/cells.h"
#include "core/study/least_squares.h"

namespace focalstage {

/// Two conditions compared, after the analysis of variance.
struct PairTest {
  int first = 0;
  int second = 0;
  double difference_m = 0.0;  ///< mean error of the first less that of the second, each target weighing the same
  double t = 0.0;
  double df = 0.0;
  double p = 1.0;  ///< of two conditions: Tukey's; of more: Holm's
};

/// The two-way analysis of variance of the errors, by condition and target, with their interaction.
///
/// Sums of squares are of type II (each main effect beside the other, the interaction beside both); where no mean is
/// missing they are the textbook's. The residual is that of all three together, over N - conditions * targets. As in
/// the paper, means of one participant count as independent.
struct Anova {
  std::optional<FTest> condition;
  std::optional<FTest> target;
  std::optional<FTest> interaction;
  double residual_ss = 0.0;
  double residual_df = 0.0;
  std::vector<PairTest> pairs;
};

/// Nothing where a condition has no mean for a target, or where there is no more than one mean for each.
std::optional<Anova> anova_of(const Study& study, const CellMeans& cells);

}  // namespace focalstage
