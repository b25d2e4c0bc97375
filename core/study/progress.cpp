#include "core/study/progress.h"

#include <cmath>
#include <string>

namespace focalstage {
namespace {

constexpr double same_m = 1e-12;

/// What a row has that its trial has not; nothing where they agree.
std::string difference(const Study& study, const TrialBlock& block, const Trial& trial, const Response& row) {
  const StudyTarget& target = study.targets[static_cast<std::size_t>(trial.target)];
  if (row.block != block.number || row.trial != trial.number) {
    return "is trial " + std::to_string(row.trial) + " of block " + std::to_string(row.block) + ", where trial " +
           std::to_string(trial.number) + " of block " + std::to_string(block.number) + " is next";
  }
  if (row.condition != block.condition) return "is of another condition than its block";
  if (row.target != trial.target || row.repetition != trial.repetition || row.training != trial.training) {
    return "is of another target or repetition than its trial";
  }
  if (std::abs(row.actual_m - target.actual_m) > same_m) return "has another distance than its target";
  if (std::abs(row.pointer_start_m - trial.pointer_start_m) > same_m) return "has another start of the pointer";
  return {};
}

}  // namespace

Result<TrialProgress> progress_of(const Study& study, const std::vector<TrialBlock>& plan,
                                  const std::vector<Response>& responses) {
  TrialProgress progress;
  for (const TrialBlock& block : plan) progress.of += static_cast<int>(block.trials.size());
  for (std::size_t k = 0; k < responses.size(); ++k) {
    const Response& row = responses[k];
    const auto wrong = [&](const std::string& what) {
      return Fault{"study.rows", "row " + std::to_string(k + 1), what,
                   "put the file back as it was written, or move it away and run the participant anew"};
    };
    if (progress.finished()) return wrong("comes after the last trial");
    const TrialBlock& block = plan[progress.block];
    const std::string what = difference(study, block, block.trials[progress.trial], row);
    if (!what.empty()) return wrong(what);
    if (row.sitting < progress.sittings) return wrong("is of an earlier sitting than the one before");
    progress.sittings = row.sitting;
    if (!row.spoiled.empty()) continue;
    ++progress.done;
    if (++progress.trial < block.trials.size()) continue;
    progress.trial = 0;
    ++progress.block;
  }
  return progress;
}

}  // namespace focalstage
