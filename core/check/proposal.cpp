#include "core/check/proposal.h"

#include <algorithm>
#include <cmath>

#include "core/check/candidates.h"
#include "core/check/check.h"
#include "core/check/words.h"
#include "core/optics/image_plan.h"
#include "core/schedule/schedule.h"

namespace focalstage {
namespace {

using Change = NearestSetting::Change;

/// The slice of the rig that has, or is nearest to, `power_d`.
int slice_for(const SolvedRig& rig, double power_d) {
  const auto nearer = [&](double a, double b) { return std::abs(a - power_d) < std::abs(b - power_d); };
  const auto nearest = std::min_element(rig.powers_d.begin(), rig.powers_d.end(), nearer);
  return static_cast<int>(nearest - rig.powers_d.begin());
}

void add_pins(const Project& project, const SolvedRig& rig, Edits& edits) {
  const std::vector<double>& powers_d = project.slices.powers_d;
  for (const Object& object : project.objects) {
    const int own = object.depth.index;
    const bool pinned = object.depth.mode == DepthMode::slice;
    if (!pinned || own < 0 || own >= static_cast<int>(powers_d.size())) continue;
    const int then = slice_for(rig, powers_d[static_cast<std::size_t>(own)]);
    if (then != own) edits.push_back(set_edit("objects", object.name, "depth/index", then));
  }
}

/// The lowest power stays below the highest at every step.
void add_sweep(const Sweep& sweep, const SolvedRig& rig, Edits& edits) {
  const bool lowest = sweep.min_power_d != rig.min_power_d;
  const bool highest = sweep.max_power_d != rig.max_power_d;
  const bool upwards = rig.min_power_d >= sweep.max_power_d;
  if (highest && upwards) edits.push_back(set_edit("sweep", "", "max_power_d", rig.max_power_d));
  if (lowest) edits.push_back(set_edit("sweep", "", "min_power_d", rig.min_power_d));
  if (highest && !upwards) edits.push_back(set_edit("sweep", "", "max_power_d", rig.max_power_d));
}

std::string ms(double time_s) { return words(time_s * 1000.0) + " ms"; }

std::string count_words(std::size_t slices) { return std::to_string(slices) + (slices == 1 ? " slice" : " slices"); }

std::string change_words(const NearestSetting& setting) {
  const std::string slices = count_words(setting.rig.powers_d.size());
  switch (setting.change) {
    case Change::exposure:
      return "an exposure every " + ms(setting.to) + " instead of " + ms(setting.from) + ", with " + slices;
    case Change::spacing:
      return "slices up to " + words(setting.to) + " D apart instead of " + words(setting.from) + " D: " + slices;
    case Change::slices:
      return slices + " instead of " + words(setting.from);
    case Change::range:
      return "only what needs " + words(setting.low_d) + " to " + words(setting.high_d) + " D, " + percent(setting.to) +
             " of the picture: " + slices;
  }
  return {};
}

std::string powers_words(const std::vector<double>& powers_d) {
  std::string text;
  for (const double power_d : powers_d) text += (text.empty() ? "" : ", ") + words(power_d);
  return text;
}

}  // namespace

std::vector<Edit> rig_edits(const Project& project, const SolvedRig& rig) {
  Edits edits;
  // An index must exist at every step: a shorter list comes after what points into it.
  const bool fewer = rig.powers_d.size() < project.slices.powers_d.size();
  if (fewer) add_pins(project, rig, edits);
  if (project.slices.powers_d != rig.powers_d) {
    edits.push_back(set_edit("slices", "", "powers_d", Value(Value::Array(rig.powers_d.begin(), rig.powers_d.end()))));
  }
  if (!fewer) add_pins(project, rig, edits);
  add_sweep(project.sweep, rig, edits);
  if (project.projectors.empty()) return edits;
  const Projector& projector = project.projectors.front();
  if (projector.frames_per_second != rig.frames_per_second) {
    edits.push_back(set_edit("projectors", projector.name, "frames_per_second", rig.frames_per_second));
  }
  if (rig.exposure_ms && projector.exposure_ms != rig.exposure_ms) {
    edits.push_back(set_edit("projectors", projector.name, "exposure_ms", *rig.exposure_ms));
  }
  return edits;
}

std::vector<Finding> errors_after(const Project& project, const std::vector<Edit>& edits,
                                  std::span<const ProjectorModelData> models) {
  const Result<Project> after = apply_all(project, edits);
  if (!after) {
    const Fault& fault = after.fault();
    return {{Severity::error, fault.code, "", fault.where + ": " + fault.message, {}, {}}};
  }
  std::vector<Finding> errors = check(*after, make_schedule(*after, image_plan(*after)), {}, models);
  std::erase_if(errors, [](const Finding& finding) { return finding.severity != Severity::error; });
  return errors;
}

std::vector<NearestProposal> nearest_proposals(const Project& project, const SolveResult& result,
                                               std::span<const ProjectorModelData> models) {
  std::vector<NearestProposal> proposals;
  for (const NearestSetting& setting : result.nearest) {
    std::vector<Edit> edits = rig_edits(project, setting.rig);
    if (!errors_after(project, edits, models).empty()) continue;
    proposals.push_back({setting, change_words(setting), std::move(edits)});
  }
  return proposals;
}

std::vector<std::string> proposal_words(const Project& project, const SolveResult& result) {
  if (!result.rig) return {};
  const SolvedRig& rig = *result.rig;
  std::vector<std::string> lines;
  const std::size_t before = project.slices.powers_d.size();
  lines.push_back(count_words(rig.powers_d.size()) + " instead of " + std::to_string(before) + ": " +
                  powers_words(rig.powers_d) + " D");
  if (!project.sweep.waveform.left && !project.sweep.waveform.right) {
    lines.push_back("sweep " + words(rig.min_power_d) + " to " + words(rig.max_power_d) + " D instead of " +
                    words(project.sweep.min_power_d) + " to " + words(project.sweep.max_power_d) + " D");
  } else {
    lines.push_back("the measured sweep stays as it is");
  }
  lines.push_back("needed " + words(result.lowest_need_d) + " to " + words(result.highest_need_d) + " D; " +
                  (rig.beyond_d > 0.0 ? "up to " + words(rig.beyond_d) + " D" : std::string("nothing")) +
                  " beyond the slices");
  lines.push_back("mean error " + words(result.after.mean_d) + " D instead of " + words(result.before.mean_d) +
                  " D; at even steps " + words(result.uniform.mean_d) + " D");
  lines.push_back("slices up to " + words(rig.widest_gap_d) + " D apart; smear up to " + words(rig.worst_smear_d) +
                  " D in an exposure");
  return lines;
}

}  // namespace focalstage
