#include <algorithm>
#include <numbers>

#include "io/assets/gltf_check.h"

namespace focalstage {
namespace {

Status check_camera(const tinygltf::Camera& camera, const std::string& where) {
  if (camera.type != "perspective") return {};
  const tinygltf::PerspectiveCamera& lens = camera.perspective;
  if (!(lens.yfov > 0.0 && lens.yfov < std::numbers::pi)) {
    return invalid_asset(where + "/perspective/yfov", "a field of view lies between 0 and pi");
  }
  if (lens.aspectRatio < 0.0) return invalid_asset(where + "/perspective/aspectRatio", "an aspect is above 0");
  return {};
}

Status check_light(const tinygltf::Light& light, const std::string& where) {
  if (light.type != "directional" && light.type != "point" && light.type != "spot") {
    return invalid_asset(where + "/type", "glTF has no such light");
  }
  const bool negative = std::any_of(light.color.begin(), light.color.end(), [](double c) { return c < 0.0; });
  if ((!light.color.empty() && light.color.size() != 3) || negative) {
    return invalid_asset(where + "/color", "a light's colour is three numbers that are not negative");
  }
  if (light.intensity < 0.0) return invalid_asset(where + "/intensity", "an intensity is not negative");
  return {};
}

}  // namespace

Status check_gltf_cameras_and_lights(const GltfDocument& document) {
  for (std::size_t i = 0; i < document.gltf.cameras.size(); ++i) {
    const Status status = check_camera(document.gltf.cameras[i], document.at("cameras", i));
    if (!status) return status;
  }
  for (std::size_t i = 0; i < document.gltf.lights.size(); ++i) {
    const Status status = check_light(document.gltf.lights[i], document.at("extensions/KHR_lights_punctual/lights", i));
    if (!status) return status;
  }
  return {};
}

}  // namespace focalstage
