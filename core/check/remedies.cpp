#include "core/check/remedies.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/check/candidates.h"
#include "core/check/rules.h"
#include "core/optics/image_plan.h"
#include "core/schedule/slots.h"

namespace focalstage {
namespace {

/// Nobody turns a remedy into a project with hundreds of slices.
constexpr std::size_t most_slices = 64;

Candidates drop_candidate(const Project& project, const Finding& finding) {
  const std::optional<std::size_t> slice = slice_of(project, finding);
  if (!slice) return {};
  const auto dropped = drop_slices(project, {*slice});
  return dropped ? Candidates{{*dropped, true}} : Candidates{};
}

/// What might make the exposure that `finding` names visible: a wider sweep, a shorter exposure, or going without.
Candidates showing_candidates(const Project& project, const Finding& finding,
                              std::span<const ProjectorModelData> models) {
  const std::optional<std::size_t> slice = slice_of(project, finding);
  const double power_d = slice ? project.slices.powers_d[*slice] : 0.0;
  Candidates candidates = sweep_candidates(project, power_d, power_d);
  const auto add = [&](const Candidates& more) { candidates.insert(candidates.end(), more.begin(), more.end()); };
  add(shorter_exposures(project, models));
  add(drop_candidate(project, finding));
  return candidates;
}

Candidates candidates_for(const Project& project, const Finding& finding, const Measured& measured,
                          std::span<const ProjectorModelData> models) {
  const std::string& code = finding.code;
  if (code == "slices.spacing") return spacing_candidates(project, finding);
  if (code == "slices.outside-sweep" || code == "schedule.hidden-by-shutter") {
    return showing_candidates(project, finding, models);
  }
  if (code == "schedule.overlap") return overlap_candidates(project, finding, models);
  if (code == "schedule.smear") return smear_candidates(project, finding, models);
  if (code == "schedule.bit-depth") return bit_depth_candidates(project, finding, models);
  if (code == "schedule.no-zero-crossing") return no_zero_crossing_candidates(project);
  if (code == "schedule.waveform") return waveform_candidates(project);
  if (code == "optics.lens-range") return lens_range_candidates(project, finding);
  if (code == "optics.lens-current") return lens_current_candidates(project);
  if (code == "depth.out-of-range") return depth_candidates(project, finding, measured);
  if (code == "light.clipped") return clipped_candidates(project, measured);
  if (code == "view.conflict") return conflict_candidates(project, finding);
  if (code == "projector.unknown-model") return model_candidates(project, finding, models);
  if (code == "projector.pixel-layout") return pixel_layout_candidates(project, finding, models);
  if (code == "slices.optimal-lattice") return {{{set_edit("slices", "", "assignment", "linear")}}};
  if (code == "frames.rate") return frame_rate_candidates(project, finding);
  if (code == "safety.flicker") return flicker_candidates(project);
  return {};
}

/// Findings to be compared: by code, and by place where places can be compared.
using Counts = std::map<std::pair<std::string, std::string>, std::size_t>;

Counts counts_of(const std::vector<Finding>& findings, bool errors_alone, bool by_place) {
  Counts counts;
  for (const Finding& finding : findings) {
    if (errors_alone && finding.severity != Severity::error) continue;
    ++counts[{finding.code, by_place ? finding.where : std::string()}];
  }
  return counts;
}

bool no_more_than(const Counts& after, const Counts& before) {
  return std::all_of(after.begin(), after.end(), [&](const auto& entry) {
    const auto found = before.find(entry.first);
    return found != before.end() && entry.second <= found->second;
  });
}

/// How good a project is after the candidate's edits: 0 the best; nothing where they do not clear the finding or bring
/// an error.
std::optional<int> rank(const Project& before, const Project& after, const Finding& finding,
                        const std::vector<Finding>& present, std::span<const ProjectorModelData> models) {
  if (after.slices.powers_d.size() > most_slices) return std::nullopt;
  const std::vector<Finding> left = planned_findings(after, time_slots(after, image_plan(after)).troubles, models);
  const auto same_code = [&](const Finding& other) { return other.code == finding.code; };
  const auto same = [&](const Finding& other) { return same_code(other) && other.where == finding.where; };
  const auto count = std::count_if(left.begin(), left.end(), same_code);
  const auto count_before = std::count_if(present.begin(), present.end(), same_code);
  // Where slices come or go, their places change: then one fewer is the proof. (What only compiling finds is in neither
  // list; its candidates clear it by how they are made.)
  const bool places_hold = before.slices.powers_d.size() == after.slices.powers_d.size();
  if (count_before > 0 && count >= count_before) return std::nullopt;
  if (places_hold && std::any_of(left.begin(), left.end(), same)) return std::nullopt;
  const auto no_more = [&](bool errors_alone) {
    return no_more_than(counts_of(left, errors_alone, places_hold), counts_of(present, errors_alone, places_hold));
  };
  if (!no_more(true)) return std::nullopt;
  return (no_more(false) ? 0 : 2) + (count == 0 ? 0 : 1);
}

}  // namespace

std::vector<Edit> remedy_for(const Project& project, const Finding& finding, const Measured& measured,
                             const std::vector<Finding>& present, std::span<const ProjectorModelData> models) {
  std::optional<std::pair<int, Edits>> best;
  const auto try_each = [&](Candidates candidates, bool giving_up) {
    for (Candidate& candidate : candidates) {
      if (candidate.edits.empty() || candidate.gives_up != giving_up || (giving_up && best)) continue;
      const Result<Project> after = apply_all(project, candidate.edits);
      if (!after) continue;
      const std::optional<int> ranked = rank(project, *after, finding, present, models);
      if (ranked && (!best || *ranked < best->first)) best = {*ranked, std::move(candidate.edits)};
      if (best && best->first == 0) return;
    }
  };
  const Candidates near = candidates_for(project, finding, measured, models);
  try_each(near, false);
  if (!best && solver_answers(finding.code)) try_each(solver_candidates(project, measured, models), false);
  if (!best) try_each(near, true);
  return best ? best->second : Edits{};
}

}  // namespace focalstage
