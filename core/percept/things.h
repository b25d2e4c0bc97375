#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/retina/retina.h"
#include "core/stage/stage.h"

namespace focalstage {

/// A named thing of the stage.
struct SeenThing {
  enum class Kind { object, surface };

  Kind kind = Kind::object;
  std::string name;
  std::size_t index = 0;  ///< in the project's list

  bool operator==(const SeenThing&) const = default;
};

/// What stands where an eye looks: virtual objects where they are meant to appear, and behind them real surfaces.
struct ThingMap {
  static constexpr std::int32_t nothing = -1;

  int width_px = 0;
  int height_px = 0;
  std::vector<SeenThing> things;    ///< objects first, both as the stage lists them
  std::vector<std::int32_t> thing;  ///< [row][column], rows from the top
  std::vector<float> vergence_d;  ///< 1 / axial distance from the lens centre: what the eyes converge on; NaN: nothing

  /// Luminance per unit of light (full code of one whole exposure), in cd/m2, on the surface seen through no power in
  /// that pixel; 0 where none is seen or its brightness is not known.
  std::vector<float> candela_per_light;
};

/// How much light a projector gives.
struct ProjectorFlux {
  double lumens = 0.0;          ///< of an all-white picture that is always on; 0: not known
  double exposure_share = 0.0;  ///< of the period, for which one exposure is on
};

/// A screen that scatters evenly returns E / pi of the illuminance E (Lambert, white): E is the flux of a pixel by the
/// pixels per square metre, which for a pinhole are fx fy |n . r| / z^3 at the point r of its space.
ThingMap things_seen(const RetinaInput& input, const RetinaView& view, const ProjectorFlux& flux,
                     const std::stop_token& stop = {});

}  // namespace focalstage
