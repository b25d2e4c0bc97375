#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <optional>

#include "editor/cli/command_list.h"
#include "editor/cli/edit_file.h"
#include "editor/cli/interrupt.h"
#include "editor/cli/output.h"
#include "editor/cli/progress.h"
#include "editor/pipeline/solve_project.h"
#include "editor/pipeline/source.h"

namespace focalstage {
namespace {

struct Options {
  std::string project;
  std::string output;
  SolveWishes wishes;
  bool json = false;
};

Value edits_value(const std::vector<Edit>& edits) {
  Value::Array list;
  for (const Edit& edit : edits) list.push_back(value_from(edit));
  return Value(std::move(list));
}

Value error_value(const PlacementError& error) {
  Value value;
  value.set("mean_d", error.mean_d);
  value.set("worst_d", error.worst_d);
  return value;
}

Value rig_value(const SolvedRig& rig) {
  Value value;
  value.set("powers_d", Value(Value::Array(rig.powers_d.begin(), rig.powers_d.end())));
  value.set("min_power_d", rig.min_power_d);
  value.set("max_power_d", rig.max_power_d);
  value.set("widest_gap_d", rig.widest_gap_d);
  value.set("worst_smear_d", rig.worst_smear_d);
  value.set("tightest_ms", rig.tightest_s * 1000.0);
  value.set("beyond_d", rig.beyond_d);
  return value;
}

Value range_value(const PowerHistogram& powers) {
  if (powers.empty()) return Value();
  return Value(Value::Array{powers.lowest_d(), powers.highest_d()});
}

Value needs_value(const Project& project, const Needs& needs) {
  Value::Array list;
  for (const ObjectNeeds& object : needs.objects) {
    Value value;
    value.set("name", project.objects[object.index].name);
    value.set("looks", static_cast<double>(object.looks));
    value.set("off_surface", static_cast<double>(object.off_surface));
    value.set("unlit", static_cast<double>(object.unlit));
    if (object.pinned_slice) value.set("slice", *object.pinned_slice);
    value.set("left_d", range_value(object.powers.left));
    value.set("right_d", range_value(object.powers.right));
    list.push_back(std::move(value));
  }
  return Value(std::move(list));
}

Value nearest_value(const std::vector<NearestProposal>& nearest) {
  Value::Array list;
  for (const NearestProposal& one : nearest) {
    Value value;
    value.set("words", one.words);
    value.set("rig", rig_value(one.setting.rig));
    value.set("edits", edits_value(one.edits));
    list.push_back(std::move(value));
  }
  return Value(std::move(list));
}

void print_report(const Project& project, const SolveReport& report) {
  Value object = findings_value(report.findings);
  object.set("solved", report.solved());
  object.set("edits", edits_value(report.edits));
  object.set("rig", report.solved() ? rig_value(*report.result.rig) : Value());
  object.set("needs", needs_value(project, report.needs));
  Value errors;
  errors.set("before", error_value(report.result.before));
  if (report.solved()) {
    errors.set("after", error_value(report.result.after));
    errors.set("uniform", error_value(report.result.uniform));
    errors.set("k_median", error_value(report.result.medians));
  }
  object.set("error", std::move(errors));
  object.set("nearest", nearest_value(report.nearest));
  print_json(object);
}

void print_summary(const Options& options, const Project& project, const SolveReport& report) {
  if (report.solved()) {
    std::printf("%s: ", options.project.c_str());
    const char* indent = "";
    for (const std::string& line : proposal_words(project, report.result)) {
      std::printf("%s%s\n", indent, line.c_str());
      indent = "  ";
    }
    if (report.edits.empty()) std::puts("  nothing is to be changed");
  } else {
    std::printf("%s: no sweep and slices keep all limits\n", options.project.c_str());
  }
  std::fputs(findings_text(report.findings).c_str(), stdout);
  for (const NearestProposal& one : report.nearest) std::printf("possible: %s\n", one.words.c_str());
}

Result<SolveReport> solve_with_progress(const Options& options, const Source& source, std::stop_token stop) {
  Progress bar("Solving " + source.project.name, options.json ? Progress::Style::quiet : Progress::Style::automatic);
  return solve_project(
      source.project, source.loaded.assets, source.models, options.wishes,
      [&](double share, const std::string&) { bar.update(share, 1.0, ""); }, std::move(stop));
}

/// Where `-o` says so, the project with the proposal applied. Nothing is written without a proposal.
Status save(const Options& options, const SolveReport& report) {
  if (options.output.empty() || !report.solved()) return {};
  const auto loaded = load_project(options.project);
  if (!loaded) return loaded.fault();
  const auto file = apply_and_save(*loaded, report.edits, options.output);
  if (!file) return file.fault();
  if (!options.json) std::printf("written to %s\n", file->c_str());
  return {};
}

bool is_nan(const std::optional<double>& wish) { return wish && std::isnan(*wish); }

ExitStatus run(const Options& options) {
  if (is_nan(options.wishes.spacing_d) || is_nan(options.wishes.max_error_d)) {
    report(Fault{"solve.number", "--spacing, --max-error", "nan is no number", ""});
    return ExitStatus::usage;
  }
  Interrupt interrupt;
  const auto source = open_project(options.project);
  if (!source) return report(source.fault());
  const auto solved = solve_with_progress(options, *source, interrupt.token());
  if (!solved) {
    const ExitStatus status = report(solved.fault());
    interrupt.end_if_asked();
    return status;
  }
  if (!options.json) print_summary(options, source->project, *solved);
  if (const Status saved = save(options, *solved); !saved) return report(saved.fault());
  if (options.json) print_report(source->project, *solved);
  return solved->solved() ? ExitStatus::done : ExitStatus::findings;
}

}  // namespace

Command::Run declare_solve(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("PROJECT", options->project, "a NAME.focal, or the folder that holds it")->required()->type_name("");
  app.add_option("--slices", options->wishes.slices, "so many slices, placed where the picture loses least")
      ->type_name("N")
      ->check(CLI::Range(1, most_solved_slices).name(""));
  app.add_option("--spacing", options->wishes.spacing_d, "how far apart slices may lie; 0.6 by default")
      ->type_name("D")
      ->check(CLI::Range(0.01, 100.0).name(""));
  app.add_option("--max-error", options->wishes.max_error_d, "the fewest slices with nothing farther from its nearest")
      ->type_name("D")
      ->check(CLI::Range(0.01, 100.0).name(""));
  app.add_option("-o,--output", options->output, "where to save the project with the proposal; nowhere by default")
      ->type_name("OUT");
  app.add_flag("--json", options->json, "print the proposal, the needs and the errors as one JSON object");
  return [options] { return run(*options); };
}

}  // namespace focalstage
