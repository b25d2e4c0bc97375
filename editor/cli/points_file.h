#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/calibrate/picked_points.h"

namespace focalstage {

/// What `focalstage calibrate points` reads: {"projector": "main", "points": [{"name": "corner", "world_m": [x, y, z],
/// "pixel": [u, v]}, ...]}; the projector may be left out where the project has one, names always.
struct PointsFile {
  std::string projector;
  std::vector<PickedPoint> points;
};

/// Faults name the file and the JSON pointer.
Result<PointsFile> read_points(const std::filesystem::path& file);

}  // namespace focalstage
