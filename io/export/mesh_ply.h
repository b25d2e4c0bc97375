#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/mesh/mesh.h"

namespace focalstage {

/// Positions (metres, double) and triangles as a binary little-endian PLY (G. Turk, "The PLY polygon file format",
/// 1994), atomically. "file.unwritable".
Status write_ply(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace focalstage
