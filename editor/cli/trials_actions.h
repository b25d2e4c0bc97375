#pragma once

#include <string>

#include "editor/cli/command.h"

namespace focalstage {

/// What the actions of `focalstage trials` are asked for; each reads what it needs.
struct TrialsOptions {
  std::string folder;
  std::string study;
  std::string participant;
  std::string rig;
  std::string out;
  std::string scripted;
  double interpupillary_mm = 0.0;  ///< 0: the project's
  bool resume = false;
  bool one_block = false;
  bool json = false;
};

/// The folder of answers beside a study.
inline constexpr const char* trials_answers_folder = "answers";

ExitStatus run_trials_new(const TrialsOptions& options);
ExitStatus run_trials_plan(const TrialsOptions& options);
ExitStatus run_trials_run(const TrialsOptions& options);
ExitStatus run_trials_report(const TrialsOptions& options);

}  // namespace focalstage
