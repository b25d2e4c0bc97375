#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace focalstage {

/// Whether the JSON is well formed and every member that the readers use has the type
/// glTF 2.0 gives it. tinygltf passes over members of a wrong type and cuts integers off; it must never see one. Faults
/// name the place: "path: /accessors/3/count". Returns the uris of its buffers and images, as written.
Result<std::vector<std::string>> check_gltf_shape(std::span<const std::byte> json, const std::string& path);

}  // namespace focalstage
