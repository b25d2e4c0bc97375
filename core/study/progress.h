#pragma once

#include <cstddef>
#include <vector>

#include "core/study/plan.h"
#include "core/study/response.h"

namespace focalstage {

/// Where a participant goes on.
struct TrialProgress {
  std::size_t block = 0;  ///< of the plan; its size when all is done
  std::size_t trial = 0;  ///< within that block
  int done = 0;           ///< trials answered or given up, training included
  int of = 0;
  int sittings = 0;  ///< so far

  bool finished() const { return done == of; }
};

/// Holds the rows of one participant, in the order they were written, against its plan: each is the trial that was
/// next, and a spoiled one leaves it next. Fault "study.rows" names the row, the first being 1.
Result<TrialProgress> progress_of(const Study& study, const std::vector<TrialBlock>& plan,
                                  const std::vector<Response>& responses);

}  // namespace focalstage
