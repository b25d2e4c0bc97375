#include <algorithm>
#include <cmath>

#include "core/check/candidates.h"
#include "core/check/rules.h"
#include "core/check/words.h"

namespace focalstage {
namespace {

Edit powers_edit(const std::vector<double>& powers_d) {
  return set_edit("slices", "", "powers_d", Value(Value::Array(powers_d.begin(), powers_d.end())));
}

}  // namespace

std::optional<std::size_t> slice_of(const Project& project, const Finding& finding) {
  for (std::size_t i = 0; i < project.slices.powers_d.size(); ++i) {
    if (finding.where == slice_pointer(i)) return i;
  }
  return std::nullopt;
}

Edits add_slices(const Project& project, const std::vector<double>& added_d) {
  std::vector<double> powers_d = project.slices.powers_d;
  const bool counted = std::any_of(project.objects.begin(), project.objects.end(),
                                   [](const Object& object) { return object.depth.mode == DepthMode::slice; });
  const bool in_order = std::is_sorted(powers_d.begin(), powers_d.end());
  powers_d.insert(powers_d.end(), added_d.begin(), added_d.end());
  if (in_order && !counted) std::sort(powers_d.begin(), powers_d.end());
  return {powers_edit(powers_d)};
}

std::optional<Edits> drop_slices(const Project& project, const std::vector<std::size_t>& dropped) {
  const auto goes = [&](std::size_t i) { return std::find(dropped.begin(), dropped.end(), i) != dropped.end(); };
  std::vector<double> kept_d;
  for (std::size_t i = 0; i < project.slices.powers_d.size(); ++i) {
    if (!goes(i)) kept_d.push_back(project.slices.powers_d[i]);
  }
  if (kept_d.empty() || kept_d.size() == project.slices.powers_d.size()) return std::nullopt;

  Edits edits;
  for (const Object& object : project.objects) {
    if (object.depth.mode != DepthMode::slice) continue;
    const auto own = static_cast<std::size_t>(std::max(0, object.depth.index));
    if (goes(own)) return std::nullopt;
    const auto before = std::count_if(dropped.begin(), dropped.end(), [&](std::size_t i) { return i < own; });
    if (before > 0) {
      edits.push_back(set_edit("objects", object.name, "depth/index", object.depth.index - static_cast<int>(before)));
    }
  }
  edits.push_back(powers_edit(kept_d));
  return edits;
}

Candidates spacing_candidates(const Project& project, const Finding& finding) {
  const std::optional<std::size_t> upper = slice_of(project, finding);
  if (!upper || !finding.amount) return {};
  const double upper_d = project.slices.powers_d[*upper];
  const double gap_d = finding.amount->value;
  const double parts = std::ceil(gap_d / wide_spacing_d - rounding);
  std::vector<double> added_d;
  for (double part = parts - 1.0; part >= 1.0; part -= 1.0) added_d.push_back(upper_d - gap_d * part / parts);
  return {{add_slices(project, added_d)}};
}

}  // namespace focalstage
