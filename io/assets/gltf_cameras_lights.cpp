#include "io/assets/gltf_cameras_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "core/base/rigid.h"

namespace focalstage {
namespace {

Value value_of(const glm::dvec3& v) { return Value(Value::Array{Value(v.x), Value(v.y), Value(v.z)}); }

Value value_of(const glm::dquat& q) { return Value(Value::Array{Value(q.x), Value(q.y), Value(q.z), Value(q.w)}); }

/// Where each node stands in the file's space.
std::vector<glm::dmat4> places_of(const std::vector<Node>& nodes) {
  std::vector<glm::dmat4> places;
  for (const Node& node : nodes) {
    const glm::dmat4 own = node.matrix
                               ? *node.matrix
                               : glm::scale(Rigid{node.pose.translation, node.pose.rotation}.matrix(), node.pose.scale);
    places.push_back(node.parent < 0 ? own : places[static_cast<std::size_t>(node.parent)] * own);
  }
  return places;
}

/// Position and gaze of what looks along its own -Z, its scale and shear left out.
Rigid pose_from(const glm::dmat4& place) {
  const glm::dvec3 back = glm::normalize(glm::dvec3(place[2]));
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(place[1]), back));
  return {glm::dvec3(place[3]), glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back)))};
}

bool is_finite(const Rigid& pose) {
  const glm::dvec3& p = pose.position_m;
  const glm::dquat& q = pose.rotation;
  return std::isfinite(p.x + p.y + p.z) && std::isfinite(q.x + q.y + q.z + q.w);
}

std::string name_or(const std::string& name, const std::string& otherwise) { return name.empty() ? otherwise : name; }

Finding viewer_finding(const Rigid& pose, const std::string& name, const std::string& where) {
  Finding finding = asset_finding(Severity::info, "asset.camera", where,
                                  "the camera " + name + " is left out; it can be the project's viewer");
  finding.remedy = {{Edit::Kind::set, "viewer", "", "position_m", value_of(pose.position_m)},
                    {Edit::Kind::set, "viewer", "", "rotation_xyzw", value_of(pose.rotation)}};
  return finding;
}

/// As many rows as full HD has, as wide as the camera's aspect asks.
Finding projector_finding(const tinygltf::PerspectiveCamera& camera, const Rigid& pose, const std::string& name,
                          const std::string& where) {
  constexpr double height_px = 1080.0;
  const double aspect = camera.aspectRatio > 0.0 ? camera.aspectRatio : 16.0 / 9.0;
  const double width_px = std::clamp(std::round(height_px * aspect), 1.0, 16384.0);
  const double focal_px = height_px / 2.0 / std::tan(camera.yfov / 2.0);
  Value item;
  item.set("width_px", width_px);
  item.set("height_px", height_px);
  item.set("fx_px", focal_px);
  item.set("fy_px", focal_px);
  item.set("cx_px", width_px / 2.0);
  item.set("cy_px", height_px / 2.0);
  item.set("position_m", value_of(pose.position_m));
  item.set("rotation_xyzw", value_of(pose.rotation));
  Finding finding = asset_finding(Severity::info, "asset.camera-projector", where,
                                  "the camera " + name + " is left out; it can be a projector of the project");
  finding.remedy = {{Edit::Kind::add, "projectors", name, "", item}};
  return finding;
}

/// glTF's lights are in lux and candela, a white surface in E lux shines with E / pi; a project's intensity is that.
Finding light_finding(const tinygltf::Light& light, const Rigid& pose, const std::string& name,
                      const std::string& where) {
  const bool sun = light.type == "directional";
  const bool has_color = light.color.size() == 3;
  const glm::dvec3 color = has_color ? glm::dvec3(light.color[0], light.color[1], light.color[2]) : glm::dvec3(1.0);
  Value item;
  item.set("kind", sun ? "sun" : "point");
  if (sun) {
    item.set("direction", value_of(pose.direction({0.0, 0.0, -1.0})));
  } else {
    item.set("position_m", value_of(pose.position_m));
  }
  item.set("color", value_of(color));
  item.set("intensity", light.intensity / std::numbers::pi);
  const std::string less = light.type == "spot" ? ", without its cone" : "";
  Finding finding = asset_finding(Severity::info, "asset.light", where,
                                  "the light " + name + " is left out; it can be a light of the project" + less);
  finding.remedy = {{Edit::Kind::add, "lights", name, "", item}};
  return finding;
}

}  // namespace

int light_of_node(const tinygltf::Node& node) {
  const auto found = node.extensions.find("KHR_lights_punctual");
  return found == node.extensions.end() ? -1 : found->second.Get("light").GetNumberAsInt();
}

std::vector<Finding> cameras_and_lights(const GltfDocument& document, const std::vector<Node>& nodes,
                                        const std::vector<int>& node_of_gltf) {
  std::vector<Finding> findings;
  const std::vector<glm::dmat4> places = places_of(nodes);
  for (std::size_t i = 0; i < document.gltf.nodes.size(); ++i) {
    const tinygltf::Node& node = document.gltf.nodes[i];
    const int light = light_of_node(node);
    if (node.camera < 0 && light < 0) continue;
    const Rigid pose = pose_from(places[static_cast<std::size_t>(node_of_gltf[i])]);
    const std::string where = document.at("nodes", i);
    if (!is_finite(pose)) {
      findings.push_back(asset_finding(Severity::warning, "asset.camera", where,
                                       "a camera or light stands nowhere: its node flattens space; it is left out"));
      continue;
    }
    if (node.camera >= 0) {
      const tinygltf::Camera& camera = document.gltf.cameras[static_cast<std::size_t>(node.camera)];
      const std::string name = name_or(camera.name, name_or(node.name, "camera " + std::to_string(node.camera)));
      findings.push_back(viewer_finding(pose, name, where + "/camera"));
      if (camera.type == "perspective") {
        findings.push_back(projector_finding(camera.perspective, pose, name, where + "/camera"));
      }
    }
    if (light >= 0) {
      const tinygltf::Light& from = document.gltf.lights[static_cast<std::size_t>(light)];
      const std::string name = name_or(from.name, name_or(node.name, "light " + std::to_string(light)));
      findings.push_back(light_finding(from, pose, name, where + "/extensions/KHR_lights_punctual"));
    }
  }
  return findings;
}

}  // namespace focalstage
