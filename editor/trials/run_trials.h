#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "editor/trials/conditions.h"
#include "editor/trials/participant.h"
#include "editor/trials/trial_rig.h"
#include "io/study/answers.h"

namespace focalstage {

/// One participant's sitting.
struct Sitting {
  const Study& study;
  std::string participant;
  std::vector<ReadyCondition> conditions;
  bool one_block = false;  ///< ends after the block under way
};

struct SittingEnd {
  TrialProgress progress;
  int spoiled = 0;  ///< in this sitting
  bool paused = false;
};

/// Runs what is left of a participant's trials, and then the questions. Each answer is on the disk before the next
/// trial is lit. Where the rig fails during a trial, its row says so and the trial is repeated; the participant is
/// asked when to go on. Between trials the rig is dark.
///
/// Faults: "trials.*", "study.show-differs" (a condition's show is not the one of earlier answers), "rig.*" where the
/// rig cannot be had, "file.unwritable". Every answer before it is kept.
Result<SittingEnd> run_trials(const Sitting& sitting, AnswerLog& log, TrialRig& rig, TrialParticipant& participant,
                              const std::stop_token& stop);

/// Shows of a study must not change while it runs: each row's against that of its condition, where it was made for the
/// same distance between the eyes.
Status check_shows(const Study& study, const std::vector<ReadyCondition>& conditions,
                   const std::vector<Response>& responses);

}  // namespace focalstage
