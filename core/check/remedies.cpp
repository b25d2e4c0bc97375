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

std::vector<Edits> drop_candidate(const Project& project, const Finding& finding) {
  const std::optional<std::size_t> slice = slice_of(project, finding);
  if (!slice) return {};
  const auto dropped = drop_slices(project, {*slice});
  return dropped ? std::vector<Edits>{*dropped} : std::vector<Edits>{};
}

/// What might make the exposure that `finding` names visible: a wider sweep, a shorter exposure, or going without.
std::vector<Edits> showing_candidates(const Project& project, const Finding& finding,
                                      std::span<const ProjectorModelData> models) {
  const std::optional<std::size_t> slice = slice_of(project, finding);
  const double power_d = slice ? project.slices.powers_d[*slice] : 0.0;
  std::vector<Edits> candidates = sweep_candidates(project, power_d, power_d);
  const auto add = [&](const std::vector<Edits>& more) {
    candidates.insert(candidates.end(), more.begin(), more.end());
  };
  add(shorter_exposures(project, models));
  add(drop_candidate(project, finding));
  return candidates;
}

std::vector<Edits> candidates_for(const Project& project, const Finding& finding, const Measured& measured,
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
  if (code == "depth.out-of-range") return depth_candidates(project, finding, measured);
  if (code == "frames.rate") return frame_rate_candidates(project, finding);
  if (code == "safety.flicker") return flicker_candidates(project);
  return {};
}

using Counts = std::map<std::string, std::size_t>;

Counts counts_of(const std::vector<Finding>& findings, bool errors_alone) {
  Counts counts;
  for (const Finding& finding : findings) {
    if (!errors_alone || finding.severity == Severity::error) ++counts[finding.code];
  }
  return counts;
}

bool no_more_than(const Counts& after, const Counts& before) {
  return std::all_of(after.begin(), after.end(), [&](const auto& entry) {
    const auto found = before.find(entry.first);
    return found != before.end() && entry.second <= found->second;
  });
}

/// How good a project is after the edits: 0 the best; nothing where they do not clear the finding or bring an error.
std::optional<int> rank(const Project& before, const Project& after, const Finding& finding,
                        const std::vector<Finding>& present, std::span<const ProjectorModelData> models) {
  if (after.slices.powers_d.size() > most_slices) return std::nullopt;
  const std::vector<Finding> left = planned_findings(after, time_slots(after, image_plan(after)).troubles, models);
  const auto same_code = [&](const Finding& other) { return other.code == finding.code; };
  const auto same = [&](const Finding& other) { return same_code(other) && other.where == finding.where; };
  const auto count = std::count_if(left.begin(), left.end(), same_code);
  const auto count_before = std::count_if(present.begin(), present.end(), same_code);
  // Where slices come or go, their places change: then one fewer is the proof.
  const bool same_places = before.slices.powers_d.size() == after.slices.powers_d.size();
  if (same_places ? std::any_of(left.begin(), left.end(), same) : count_before > 0 && count >= count_before) {
    return std::nullopt;
  }
  if (!no_more_than(counts_of(left, true), counts_of(present, true))) return std::nullopt;
  const bool no_new_warning = no_more_than(counts_of(left, false), counts_of(present, false));
  return (no_new_warning ? 0 : 2) + (count == 0 ? 0 : 1);
}

}  // namespace

std::vector<Edit> remedy_for(const Project& project, const Finding& finding, const Measured& measured,
                             const std::vector<Finding>& present, std::span<const ProjectorModelData> models) {
  std::optional<std::pair<int, Edits>> best;
  for (Edits& edits : candidates_for(project, finding, measured, models)) {
    if (edits.empty()) continue;
    const Result<Project> after = apply_all(project, edits);
    if (!after) continue;
    const std::optional<int> ranked = rank(project, *after, finding, present, models);
    if (!ranked || (best && best->first <= *ranked)) continue;
    best = {*ranked, std::move(edits)};
    if (*ranked == 0) break;
  }
  return best ? best->second : Edits{};
}

}  // namespace focalstage
