#pragma once

#include <optional>
#include <string_view>

#include "devices/roles/motion_input.h"

namespace focalstage {

/// A line of the file as what it says: "push X Y Z turn X Y Z buttons N", numbers from -1 to 1 and a bit field. None
/// for any other line.
std::optional<Deflection> sample_deflection(std::string_view line);

}  // namespace focalstage
