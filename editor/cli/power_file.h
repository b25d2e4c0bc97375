#pragma once

#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "core/base/sides.h"
#include "core/schedule/wanted_power.h"

namespace focalstage {

/// The power of one period, in dioptres, from a text file: one sample a line for both eyes, or two for left and right,
/// parted by commas, semicolons or blanks; lines that begin with # say nothing. Faults name the line.
Result<PerEye<std::vector<double>>> read_power(const std::filesystem::path& file);

}  // namespace focalstage
