#pragma once

#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "core/calibrate/align.h"

namespace focalstage {

/// Pairs of points from a CSV file: the line with the columns' names, "name,tracker_x_m,tracker_y_m,tracker_z_m,
/// world_x_m,world_y_m,world_z_m", then a pair a line; lines that begin with # say nothing. "align.file" names the
/// line.
Result<std::vector<PointPair>> read_pairs(const std::filesystem::path& file);

}  // namespace focalstage
