#include <algorithm>
#include <cmath>

#include "core/check/candidates.h"
#include "core/check/rules.h"
#include "core/check/words.h"

namespace focalstage {
namespace {

/// How far an object's wanted powers lie beyond the outermost slices, over all frames.
struct Beyond {
  double below_d = 0.0;
  double above_d = 0.0;
};

Beyond beyond_of(const Measured& measured, std::size_t object) {
  Beyond beyond;
  for (const FrameMeasure& frame : measured.frames) {
    for (const ObjectMeasure& measure : frame.objects) {
      if (measure.index != object) continue;
      const bool sided = measure.worst_below_d > 0.0 || measure.worst_above_d > 0.0;
      beyond.below_d = std::max(beyond.below_d, sided ? measure.worst_below_d : measure.worst_beyond_d);
      beyond.above_d = std::max(beyond.above_d, sided ? measure.worst_above_d : measure.worst_beyond_d);
    }
  }
  return beyond;
}

/// Slices from `edge_d` (not included) outwards by at least `beyond_d`, evenly and no wider apart than is good.
void add_outwards(double edge_d, double beyond_d, double way, std::vector<double>& added_d) {
  if (beyond_d <= most_beyond_d) return;
  const double last_d = way * std::ceil(way * (edge_d + way * beyond_d) * 20.0 - rounding) / 20.0;  // readable: 0.05 D
  const double parts = std::ceil(std::abs(last_d - edge_d) / wide_spacing_d - rounding);
  for (double part = 1.0; part <= parts; part += 1.0) added_d.push_back(edge_d + (last_d - edge_d) * part / parts);
}

/// More slices, and a sweep that shows them.
std::optional<Edits> reach_farther(const Project& project, const Beyond& beyond) {
  const std::vector<double>& powers_d = project.slices.powers_d;
  if (powers_d.empty()) return std::nullopt;
  const auto [lowest, highest] = std::minmax_element(powers_d.begin(), powers_d.end());
  std::vector<double> added_d;
  add_outwards(*lowest, beyond.below_d, -1.0, added_d);
  add_outwards(*highest, beyond.above_d, 1.0, added_d);
  if (added_d.empty()) return std::nullopt;
  Edits edits = add_slices(project, added_d);
  const double low_d = std::min(*lowest, *std::min_element(added_d.begin(), added_d.end()));
  const double high_d = std::max(*highest, *std::max_element(added_d.begin(), added_d.end()));
  if (const auto wider = widen_sweep(project, low_d, high_d)) edits.insert(edits.end(), wider->begin(), wider->end());
  return edits;
}

/// The object pulled into the range of the slices: its wanted power falls by what its vergence rises.
std::optional<Edits> pull_in(const Object& object, const Beyond& beyond) {
  if (beyond.below_d > 0.0 && beyond.above_d > 0.0) return std::nullopt;
  const double shift_d =
      beyond.above_d > 0.0 ? std::ceil(beyond.above_d * 20.0) / 20.0 : -std::ceil(beyond.below_d * 20.0) / 20.0;
  switch (object.depth.mode) {
    case DepthMode::fixed:
    case DepthMode::offset:
      return Edits{set_edit("objects", object.name, "depth/vergence_d", object.depth.vergence_d + shift_d)};
    case DepthMode::placed: {
      Value::Object offset{{"mode", Value("offset")}, {"vergence_d", Value(shift_d)}};
      return Edits{set_edit("objects", object.name, "depth", Value(std::move(offset)))};
    }
    case DepthMode::slice:
      break;
  }
  return std::nullopt;
}

}  // namespace

Candidates depth_candidates(const Project& project, const Finding& finding, const Measured& measured) {
  Candidates candidates;
  const int last = static_cast<int>(project.slices.powers_d.size()) - 1;
  for (std::size_t i = 0; i < project.objects.size(); ++i) {
    const Object& object = project.objects[i];
    const std::string where = item_pointer("objects", i) + "/depth";
    if (finding.where == where + "/index" && last >= 0) {
      candidates.push_back(
          {{set_edit("objects", object.name, "depth/index", std::clamp(object.depth.index, 0, last))}});
    }
    if (finding.where != where) continue;
    const Beyond beyond = beyond_of(measured, i);
    if (const auto farther = reach_farther(project, beyond)) candidates.push_back({*farther});
    if (const auto nearer = pull_in(object, beyond)) candidates.push_back({*nearer, true});
  }
  return candidates;
}

Candidates conflict_candidates(const Project& project, const Finding& finding) {
  for (std::size_t i = 0; i < project.objects.size(); ++i) {
    const Object& object = project.objects[i];
    if (finding.where != item_pointer("objects", i) + "/depth" || object.depth.mode == DepthMode::placed) continue;
    Value placed;
    placed.set("mode", "placed");
    return {{{set_edit("objects", object.name, "depth", std::move(placed))}}};
  }
  return {};
}

}  // namespace focalstage
