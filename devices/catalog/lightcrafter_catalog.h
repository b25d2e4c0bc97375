#pragma once

#include <memory>

#include "core/base/result.h"
#include "devices/roles/projector.h"
#include "io/rig_config/rig_config.h"

namespace focalstage {

/// A LightCrafter on a video output of the kernel's. "rig.config" with the place in the file.
Result<std::shared_ptr<ProjectorDevice>> make_lightcrafter_projector(const DeviceConfig& device);

}  // namespace focalstage
