#pragma once

#include <string>
#include <vector>

#include "core/study/response.h"
#include "core/study/study.h"

namespace focalstage {

/// What one participant estimated for one target under one condition: the mean of the answered repetitions. These means
/// are what the paper's statistics are of.
struct CellMean {
  int participant = 0;  ///< of the study's
  int condition = 0;
  int target = 0;
  double actual_m = 0.0;
  double estimated_m = 0.0;
  int answered = 0;

  double error_m() const { return estimated_m - actual_m; }
};

/// A mean that would be of nothing: every repetition was given up.
struct EmptyCell {
  int participant = 0;
  int condition = 0;
  int target = 0;
};

/// The means that statistics may use, and what was left out of them and why: nothing goes silently.
struct CellMeans {
  std::vector<CellMean> means;
  std::vector<EmptyCell> empty;
  std::vector<int> unfinished;  ///< participants whose trials are not all there: left out
  std::vector<int> left_out;    ///< by the study's rule, for an empty cell
  std::vector<int> used;        ///< participants in `means`
};

/// Training and spoiled trials are no data. `responses` are of participants of the study, in any order.
CellMeans cells_of(const Study& study, const std::vector<Response>& responses);

}  // namespace focalstage
