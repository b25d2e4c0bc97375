#pragma once

#include <array>
#include <vector>

#include "core/base/sides.h"
#include "io/rig_config/tracker_config.h"

namespace focalstage {

/// A line that the projector lights and that a light sensor sees sharply through one power of the lens.
struct LightTargetConfig {
  double power_d = 0.0;
  double spread_d = 0.01;                     ///< how well that power is known: standard uncertainty
  PerEye<std::array<int, 4>> rectangle_px{};  ///< left, top, width, height in the projector's picture

  bool operator==(const LightTargetConfig&) const = default;
};

/// What looks at the light of the rig, behind each eye's lens and shutter.
struct LightSensorConfig {
  DeviceConfig device;
  std::vector<LightTargetConfig> targets;

  bool operator==(const LightSensorConfig&) const = default;
};

}  // namespace focalstage
