#pragma once

#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "core/base/result.h"

namespace focalstage {

/// The JSON, if it is well formed and every member that the readers use has the type glTF 2.0 gives it. tinygltf passes
/// over members of a wrong type and cuts integers off; it must never see one. Faults name the place: "path:
/// /accessors/3/count".
Result<nlohmann::json> check_gltf_shape(std::span<const std::byte> json, const std::string& path);

}  // namespace focalstage
