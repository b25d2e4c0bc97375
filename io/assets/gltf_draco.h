#pragma once

#include <tiny_gltf.h>

#include "core/base/result.h"

namespace focalstage {

/// Unpacks every primitive with KHR_draco_mesh_compression into buffers of its own, and lets its accessors lie there:
/// to all that comes after, the file never was compressed. Views must have been checked, nothing else yet. Faults
/// "asset.invalid", "asset.too-large", with the place.
Status decode_gltf_draco(tinygltf::Model& gltf, const std::string& path);

}  // namespace focalstage
