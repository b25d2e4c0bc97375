#include <cstdio>
#include <filesystem>

#include "core/base/number_words.h"
#include "core/study/plan.h"
#include "editor/cli/output.h"
#include "editor/cli/trials_actions.h"
#include "editor/samples/samples.h"
#include "editor/trials/example_study.h"
#include "io/files/files.h"
#include "io/study/study_file.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

Status make_new(const TrialsOptions& options) {
  const fs::path folder = options.folder;
  std::error_code problem;
  if (fs::exists(folder, problem) && (!fs::is_directory(folder, problem) || !fs::is_empty(folder, problem))) {
    return Fault{"project.exists", folder.string(), "is there already and not empty", "choose another name"};
  }
  const auto sample = sample_named(example_project);
  if (!sample) return sample.fault();
  const auto made = write_sample(*sample, folder / example_project);
  if (!made) return made.fault();
  return write_file_atomically(folder / study_file_name, study_text(example_study()));
}

Value plan_value(const Study& study, const std::vector<TrialBlock>& plan) {
  Value::Array blocks;
  for (const TrialBlock& block : plan) {
    Value::Array trials;
    for (const Trial& trial : block.trials) {
      Value item;
      item.set("trial", trial.number);
      item.set("training", trial.training);
      item.set("target", study.targets[static_cast<std::size_t>(trial.target)].name);
      item.set("repetition", trial.repetition);
      item.set("pointer_start_m", trial.pointer_start_m);
      trials.push_back(std::move(item));
    }
    Value value;
    value.set("block", block.number);
    value.set("condition", study.conditions[static_cast<std::size_t>(block.condition)].name);
    value.set("trials", std::move(trials));
    blocks.push_back(std::move(value));
  }
  Value value;
  value.set("blocks", std::move(blocks));
  return value;
}

std::string plan_text(const Study& study, const std::vector<TrialBlock>& plan) {
  std::vector<std::vector<std::string>> rows;
  for (const TrialBlock& block : plan) {
    for (const Trial& trial : block.trials) {
      rows.push_back({std::to_string(block.number), study.conditions[static_cast<std::size_t>(block.condition)].name,
                      std::to_string(trial.number), trial.training ? "training" : std::to_string(trial.repetition),
                      study.targets[static_cast<std::size_t>(trial.target)].name,
                      fixed_text(trial.pointer_start_m * 1e3, 1)});
    }
  }
  return table_text(
      {{"block", true}, {"condition"}, {"trial", true}, {"repetition", true}, {"target"}, {"pointer mm", true}}, rows);
}

}  // namespace

ExitStatus run_trials_new(const TrialsOptions& options) {
  if (const Status made = make_new(options); !made) return report(made.fault());
  std::printf("%s: a study to start from; docs/trials.md says what to change\n",
              (fs::path(options.folder) / study_file_name).lexically_normal().c_str());
  return ExitStatus::done;
}

ExitStatus run_trials_plan(const TrialsOptions& options) {
  const auto loaded = load_study(options.study);
  if (!loaded) return report(loaded.fault());
  const auto index = participant_index(loaded->study, options.participant);
  if (!index) return report(index.fault());
  const std::vector<TrialBlock> plan = plan_of(loaded->study, *index);
  if (options.json) {
    print_json(plan_value(loaded->study, plan));
  } else {
    std::fputs(plan_text(loaded->study, plan).c_str(), stdout);
  }
  return ExitStatus::done;
}

}  // namespace focalstage
