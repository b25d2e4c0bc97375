#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/percept/things.h"
#include "core/retina/retina.h"

namespace focalstage {

/// Beyond this much between vergence and accommodation people see double or blurred before long: half a dioptre either
/// way is within the zone of comfort at any distance (Shibata et al. 2011, whose zone is wider).
inline constexpr double comfort_d = 0.5;

/// The vergence-accommodation conflict: where the eyes converge less where the show lets them focus, in dioptres, pixel
/// by pixel; positive: the focus lies further away. NaN where nothing stands or nothing is lit.
std::vector<float> conflict_map(const ThingMap& things, const DrivenFocus& focus);

/// How a conflict is shown: green within the zone of comfort, red where the focus lies further away, blue where it lies
/// nearer, the stronger the larger, at 2 D in full.
std::array<std::uint8_t, 3> conflict_colour(double conflict_d);

/// Of one thing, over its lit pixels by their light.
struct ThingConflict {
  std::size_t thing = 0;        ///< in the map's things
  double mean_d = 0.0;          ///< signed
  double worst_d = 0.0;         ///< signed: what 95 % of the light stays below, in size
  double beyond_comfort = 0.0;  ///< share of its light
  double light = 0.0;           ///< over its pixels; 0: nothing of it is lit
};

/// One for every thing of the map.
std::vector<ThingConflict> thing_conflicts(const ThingMap& things, const DrivenFocus& focus);

}  // namespace focalstage
