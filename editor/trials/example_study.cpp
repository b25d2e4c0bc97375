#include "editor/trials/example_study.h"

namespace focalstage {

Study example_study() {
  Study study;
  study.name = "Depth matching";
  study.seed = 2021;
  for (const char* id : {"P01", "P02", "P03", "P04", "P05", "P06", "P07", "P08", "P09", "P10"}) {
    study.participants.emplace_back(id);
  }
  study.conditions = {{"multifocal", example_project, "", ConditionVariant::multifocal},
                      {"conventional", example_project, "", ConditionVariant::conventional}};
  study.targets = {{"333 mm", "333 mm", -1, 0.333333},
                   {"364 mm", "364 mm", -1, 0.364},
                   {"400 mm", "400 mm", -1, 0.4},
                   {"444 mm", "444 mm", -1, 0.444},
                   {"500 mm", "500 mm", -1, 0.5}};
  study.repetitions = 4;
  study.training_trials = 1;
  study.pointer = {0.2, 0.8, 0.001};
  study.questions = {{"flicker", "Did you perceive any flicker of the displayed object?"}};
  return study;
}

}  // namespace focalstage
