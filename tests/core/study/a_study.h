#pragma once

#include <string>

#include "core/study/study.h"

namespace focalstage {

/// The paper's study: ten participants, two conditions, five distances, four repetitions, one training trial.
inline Study paper_study() {
  Study study;
  study.name = "Depth matching";
  study.seed = 7;
  for (int k = 1; k <= 10; ++k) study.participants.push_back((k < 10 ? "P0" : "P") + std::to_string(k));
  study.conditions = {{"multifocal", "depth-matching", "", ConditionVariant::multifocal},
                      {"conventional", "depth-matching", "", ConditionVariant::conventional}};
  study.targets = {{"333 mm", "333 mm", -1, 1.0 / 3.0},
                   {"364 mm", "364 mm", -1, 0.364},
                   {"400 mm", "400 mm", -1, 0.4},
                   {"444 mm", "444 mm", -1, 0.444},
                   {"500 mm", "500 mm", -1, 0.5}};
  study.pointer = {0.2, 0.8, 0.001};
  study.questions = {{"flicker", "Did you perceive any flicker?"}};
  return study;
}

}  // namespace focalstage
