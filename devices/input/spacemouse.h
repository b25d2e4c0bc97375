#pragma once

#include <memory>

#include "devices/input/settings.h"
#include "devices/roles/motion_input.h"

namespace focalstage {

/// A 3Dconnexion SpaceMouse over hidraw. Faults: "input.absent", "input.permission" (install the udev rule),
/// "input.lost".
std::unique_ptr<MotionInput> make_spacemouse(const SpaceMouseSettings& settings = {});

}  // namespace focalstage
