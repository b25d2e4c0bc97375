#include "core/study/response.h"

#include <cstddef>

namespace focalstage {

Response response_to(const Study& study, const TrialBlock& block, const Trial& trial) {
  Response response;
  response.block = block.number;
  response.condition = block.condition;
  response.trial = trial.number;
  response.training = trial.training;
  response.target = trial.target;
  response.repetition = trial.repetition;
  response.actual_m = study.targets[static_cast<std::size_t>(trial.target)].actual_m;
  response.pointer_start_m = trial.pointer_start_m;
  return response;
}

}  // namespace focalstage
