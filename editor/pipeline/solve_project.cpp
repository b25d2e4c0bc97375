#include "editor/pipeline/solve_project.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/check/check.h"
#include "core/check/rules.h"
#include "core/optics/image_plan.h"
#include "core/schedule/schedule.h"
#include "editor/pipeline/measure_frames.h"
#include "editor/pipeline/measure_needs.h"

namespace focalstage {
namespace {

constexpr int most_rounds = 3;  ///< of solving for what compiling saw

Fault cancelled(const Project& project) { return {"solve.cancelled", project.name, "stopped before the end", ""}; }

/// What compiling every frame of the project says.
Result<Measured> measured_by_compiling(const Project& project, const Assets& assets, const FrameProgress& progress,
                                       const std::stop_token& stop) {
  FrameMaker maker(project, assets, {});
  auto measured = measure_frames(maker, {{0, project.frames.count}, plain(schedules_of(maker))}, progress, stop);
  if (!measured && stop.stop_requested()) return cancelled(project);
  return measured;
}

/// Adds to the needs what compiling saw beyond the outermost slices. True if that was more than is allowed.
bool widen(const Project& solved, const Measured& measured, Needs& needs) {
  const auto [lowest, highest] = std::minmax_element(solved.slices.powers_d.begin(), solved.slices.powers_d.end());
  bool widened = false;
  std::vector<FrameMeasure> frames = measured.frames;
  for (const std::vector<FrameMeasure>& more : measured.others) frames.insert(frames.end(), more.begin(), more.end());
  for (const FrameMeasure& frame : frames) {
    for (const ObjectMeasure& object : frame.objects) {
      if (!(object.worst_beyond_d > most_beyond_d)) continue;
      ObjectNeeds more;
      more.index = object.index;
      if (object.worst_below_d > most_beyond_d) more.powers.left.add(*lowest - object.worst_below_d, 1);
      if (object.worst_above_d > most_beyond_d) more.powers.left.add(*highest + object.worst_above_d, 1);
      needs.add({more});
      widened = true;
    }
  }
  return widened;
}

void propose(const Project& project, std::span<const ProjectorModelData> models, SolveReport& report) {
  if (!report.result.rig) {
    report.nearest = nearest_proposals(project, report.result, models);
    report.findings = solve_findings(project, report.result, report.nearest);
    return;
  }
  report.edits = rig_edits(project, *report.result.rig);
  report.findings = errors_after(project, report.edits, models);
}

/// Takes the proposal back: errors remain that sweep and slices do not mend.
void withdraw(SolveReport& report) {
  report.result.rig.reset();
  report.edits.clear();
  std::erase_if(report.findings, [](const Finding& finding) { return finding.severity != Severity::error; });
}

}  // namespace

Result<SolveReport> solve_project(const Project& project, const Assets& assets,
                                  std::span<const ProjectorModelData> models, const SolveWishes& wishes,
                                  const SolveProgress& progress, std::stop_token stop) {
  if (project.projectors.empty()) {
    return Fault{"project.no-projector", "/projectors", "the project has no projector", "add one"};
  }
  const auto part = [&](double from, double share, const char* what) {
    return [&progress, from, share, what](int done, int of) {
      progress(from + share * done / of,
               std::string(what) + " frame " + std::to_string(done) + " of " + std::to_string(of));
    };
  };
  auto needs = measure_needs(project, assets, {0, project.frames.count}, part(0.0, 0.4, "measured"), stop);
  if (!needs) return needs.fault();

  SolveReport report;
  report.needs = *std::move(needs);
  Needs solved_for = report.needs;
  for (int round = 1;; ++round) {
    progress(0.4, "solving");
    report.result = solve(project, solved_for, wishes, models, {SolveBounds{}.steps, stop});
    if (stop.stop_requested()) return cancelled(project);
    propose(project, models, report);
    if (!report.solved()) return report;
    if (has_error(report.findings)) {
      withdraw(report);
      return report;
    }
    const Result<Project> solved = apply_all(project, report.edits);
    if (!solved) return solved.fault();
    const auto measured = measured_by_compiling(*solved, assets, part(0.5, 0.5, "proved"), stop);
    if (!measured) return measured.fault();
    report.findings = check(*solved, make_schedule(*solved, image_plan(*solved)), *measured, models);
    if (round == most_rounds || !widen(*solved, *measured, solved_for)) break;
  }
  if (has_error(report.findings)) withdraw(report);
  return report;
}

}  // namespace focalstage
