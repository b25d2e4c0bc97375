#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "devices/roles/device.h"

namespace focalstage {

/// The name of a 3Dconnexion motion controller by its USB ids; none for anything else, their CadMouse and keypads too.
std::optional<std::string_view> spacemouse_model(std::uint16_t vendor, std::uint16_t product);

/// What is plugged in of these. Nothing is opened.
std::vector<DeviceId> probe_spacemouse();

}  // namespace focalstage
