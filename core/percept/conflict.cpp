#include "core/percept/conflict.h"

#include <algorithm>
#include <cmath>

namespace focalstage {
namespace {

struct LitConflict {
  double conflict_d = 0.0;
  double light = 0.0;
};

/// The signed conflict that 95 % of the light stays below in size.
double worst_of(std::vector<LitConflict>& all, double light) {
  std::sort(all.begin(), all.end(),
            [](const LitConflict& a, const LitConflict& b) { return std::abs(a.conflict_d) < std::abs(b.conflict_d); });
  double sum = 0.0;
  for (const LitConflict& one : all) {
    sum += one.light;
    if (sum >= 0.95 * light) return one.conflict_d;
  }
  return all.empty() ? 0.0 : all.back().conflict_d;
}

}  // namespace

std::vector<float> conflict_map(const ThingMap& things, const DrivenFocus& focus) {
  std::vector<float> map(things.vergence_d.size());
  for (std::size_t i = 0; i < map.size(); ++i) map[i] = things.vergence_d[i] - focus.vergence_d[i];
  return map;
}

std::array<std::uint8_t, 3> conflict_colour(double conflict_d) {
  constexpr double full_d = 2.0;
  if (std::abs(conflict_d) <= comfort_d) return {0, 160, 0};
  const auto strong = static_cast<std::uint8_t>(80.0 + 175.0 * std::min(1.0, std::abs(conflict_d) / full_d));
  if (conflict_d > 0.0) return {strong, 0, 0};
  return {0, 0, strong};
}

std::vector<ThingConflict> thing_conflicts(const ThingMap& things, const DrivenFocus& focus) {
  const std::vector<float> map = conflict_map(things, focus);
  std::vector<std::vector<LitConflict>> lit(things.things.size());
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (things.thing[i] == ThingMap::nothing || std::isnan(map[i])) continue;
    lit[static_cast<std::size_t>(things.thing[i])].push_back({map[i], focus.luminance[i]});
  }
  std::vector<ThingConflict> all;
  for (std::size_t i = 0; i < lit.size(); ++i) {
    ThingConflict one;
    one.thing = i;
    for (const LitConflict& pixel : lit[i]) {
      one.light += pixel.light;
      one.mean_d += pixel.light * pixel.conflict_d;
      if (std::abs(pixel.conflict_d) > comfort_d) one.beyond_comfort += pixel.light;
    }
    if (one.light > 0.0) {
      one.mean_d /= one.light;
      one.beyond_comfort /= one.light;
      one.worst_d = worst_of(lit[i], one.light);
    }
    all.push_back(one);
  }
  return all;
}

}  // namespace focalstage
