#pragma once

#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "core/calibrate/eye_mount.h"

namespace focalstage {

/// The first line of a file of sightings.
inline constexpr const char* sighting_columns =
    "name,eye,body_x_m,body_y_m,body_z_m,body_qx,body_qy,body_qz,body_qw,mark_x_m,mark_y_m,mark_z_m,"
    "spot_x_m,spot_y_m,spot_z_m";

/// Sightings from a CSV file, the body's poses as the tracker told them. "sightings.file" names the line.
Result<std::vector<Sighting>> read_sightings(const std::filesystem::path& file, const Rigid& world_from_tracker);

}  // namespace focalstage
