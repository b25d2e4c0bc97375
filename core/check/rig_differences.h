#pragma once

#include <optional>
#include <vector>

#include "core/scene/finding.h"
#include "core/scene/project.h"

namespace focalstage {

/// What a rig says of itself: measured, not wished for.
struct RigValues {
  PerEye<LensResponse> lens_response;
  double shutter_open_ms = 3.0;
  double shutter_close_ms = 0.1;
  double latency_ms = 0.0;            ///< of the projector
  std::optional<double> exposure_ms;  ///< how long it shows an image, if it does not let us say
  int width_px = 1024;
  int height_px = 768;
  PixelLayout pixel_layout = PixelLayout::square;
  std::size_t projectors = 1;  ///< how many it has; the values above are the first one's

  bool operator==(const RigValues&) const = default;
};

/// Where the project's rig is not the one that is there, `rig.differs` each: a lens that would be off by more than
/// 0.02 D when it gets the project's drive, a latency, shutter time or exposure off by more than 20 us, another image
/// size or lattice of pixels, fewer projectors. The remedies adopt the rig's values.
std::vector<Finding> rig_differences(const Project& project, const RigValues& rig);

}  // namespace focalstage
