#pragma once

#include <tiny_gltf.h>

#include "io/assets/mesh_file.h"

namespace focalstage {

/// What tinygltf makes of a .gltf or .glb and of the files it refers to, or why nothing. Its container and the shape of
/// its JSON are checked; what the numbers mean is not (check_gltf).
Result<tinygltf::Model> parse_gltf(const FileToRead& file);

}  // namespace focalstage
