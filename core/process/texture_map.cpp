#include "core/process/texture_map.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/mesh/measure.h"
#include "core/process/sculpt.h"

namespace focalstage {

namespace {

/// Of a projector's picture: rows from the top.
glm::dvec2 pixel_of(const UvProjectorStep& lens, const glm::dvec3& point_m) {
  const double depth_m = -point_m.z;
  return {lens.cx_px + lens.fx_px * point_m.x / depth_m, lens.cy_px - lens.fy_px * point_m.y / depth_m};
}

/// A mesh whose edges are cut in two where a projector's picture would be off between their ends.
class CutMesh {
 public:
  CutMesh(const Mesh& mesh, const UvProjectorStep& lens, const glm::dmat4& projector_from_mesh)
      : mesh_(mesh), lens_(lens), projector_from_mesh_(projector_from_mesh) {
    for (const glm::dvec3& position : mesh.positions_m) pixels_.push_back(pixel_at(position));
  }

  /// One round; false where nothing was to be cut.
  bool cut() {
    const std::vector<glm::uvec3> before = std::exchange(mesh_.triangles, {});
    middles_.clear();
    for (const glm::uvec3& triangle : before) cut(triangle);
    return mesh_.triangles.size() > before.size();
  }

  std::size_t triangles() const { return mesh_.triangles.size(); }

  Mesh take() {
    mesh_.uvs.clear();
    for (const glm::dvec2& pixel : pixels_)
      mesh_.uvs.emplace_back(pixel.x / lens_.width_px, 1.0 - pixel.y / lens_.height_px);
    return std::move(mesh_);
  }

 private:
  glm::dvec2 pixel_at(const glm::dvec3& position) const {
    return pixel_of(lens_, glm::dvec3(projector_from_mesh_ * glm::dvec4(position, 1.0)));
  }

  /// Told by the places of its ends alone, in either order, so that all triangles along an edge agree.
  bool strays(const glm::dvec3& one_m, const glm::dvec3& other_m) const {
    const glm::dvec2 one = pixel_at(one_m), other = pixel_at(other_m);
    const glm::dvec2 size_px(lens_.width_px, lens_.height_px);
    const glm::dvec2 low = glm::min(one, other), high = glm::max(one, other);
    if (high.x < 0.0 || high.y < 0.0 || low.x > size_px.x || low.y > size_px.y) return false;
    // A projective map of an edge is off the most near its middle, by at most a little more than there.
    return glm::distance(pixel_at(0.5 * (one_m + other_m)), 0.5 * (one + other)) > 0.5 * most_stray_px;
  }

  /// The vertex half-way along an edge that must be cut.
  std::optional<std::uint32_t> middle(std::uint32_t one, std::uint32_t other) {
    if (one > other) std::swap(one, other);
    const auto [entry, is_new] = middles_.try_emplace({one, other});
    if (!is_new || !strays(mesh_.positions_m[one], mesh_.positions_m[other])) return entry->second;
    entry->second = static_cast<std::uint32_t>(mesh_.positions_m.size());
    mesh_.positions_m.push_back(0.5 * (mesh_.positions_m[one] + mesh_.positions_m[other]));
    pixels_.push_back(pixel_at(mesh_.positions_m.back()));
    if (!mesh_.colors.empty()) mesh_.colors.push_back(0.5 * (mesh_.colors[one] + mesh_.colors[other]));
    if (!mesh_.normals.empty()) mesh_.normals.push_back(normal_between(mesh_.normals[one], mesh_.normals[other]));
    return entry->second;
  }

  static glm::dvec3 normal_between(const glm::dvec3& one, const glm::dvec3& other) {
    const double length = glm::length(one + other);
    return length > 0.0 ? (one + other) / length : one;
  }

  void cut(const glm::uvec3& t) {
    const std::array<std::optional<std::uint32_t>, 3> middles{middle(t.x, t.y), middle(t.y, t.z), middle(t.z, t.x)};
    // Round its border, each corner and each middle; a corner between two middles is cut off, and a fan, from the
    // middle where there is but one, makes the rest.
    std::vector<std::uint32_t> border;
    for (int k = 0; k < 3; ++k) {
      const auto side = static_cast<std::size_t>(k);
      const auto& before = middles[(side + 2) % 3];
      if (before && middles[side]) {
        mesh_.triangles.emplace_back(*before, t[k], *middles[side]);
      } else {
        border.push_back(t[k]);
      }
      if (middles[side]) border.push_back(*middles[side]);
    }
    const auto is_middle = [&](std::uint32_t vertex) { return vertex != t.x && vertex != t.y && vertex != t.z; };
    if (border.size() == 4 && std::ranges::count_if(border, is_middle) == 1) {
      std::ranges::rotate(border, std::ranges::find_if(border, is_middle));
    }
    for (std::size_t i = 1; i + 1 < border.size(); ++i) {
      mesh_.triangles.emplace_back(border[0], border[i], border[i + 1]);
    }
  }

  Mesh mesh_;
  const UvProjectorStep& lens_;
  glm::dmat4 projector_from_mesh_;
  std::vector<glm::dvec2> pixels_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::optional<std::uint32_t>> middles_;
};

Status in_front(const Mesh& mesh, const glm::dmat4& projector_from_mesh) {
  std::vector<bool> behind;
  for (const glm::dvec3& position : mesh.positions_m) {
    behind.push_back(-(projector_from_mesh * glm::dvec4(position, 1.0)).z < nearest_thrown_m);
  }
  const auto reaching = std::ranges::count_if(
      mesh.triangles, [&](const glm::uvec3& t) { return behind[t.x] || behind[t.y] || behind[t.z]; });
  if (reaching == 0) return {};
  return Fault{"process.behind-projector", "position_m",
               std::to_string(reaching) + " of " + std::to_string(mesh.triangles.size()) +
                   " triangles reach behind the projector",
               "move it back or turn it, or keep a part of the mesh before"};
}

}  // namespace

Result<Mesh> mapped_by_plane(const Mesh& mesh, const UvPlaneStep& step, const glm::dmat4& room_from_mesh) {
  const glm::dmat4 plane_from_mesh = step.pose.inverse().matrix() * room_from_mesh;
  Mesh mapped = mesh;
  std::vector<glm::dvec3> places_m;
  for (const glm::dvec3& p : mesh.positions_m) places_m.emplace_back(plane_from_mesh * glm::dvec4(p, 1.0));
  glm::dvec2 low_m, size_m;
  if (step.size_m) {
    size_m = *step.size_m;
    low_m = -0.5 * size_m;
  } else {
    Bounds bounds;
    for (const glm::uvec3& t : mesh.triangles) {
      for (int k = 0; k < 3; ++k) bounds.include(places_m[t[k]]);
    }
    low_m = glm::dvec2(bounds.min_m);
    size_m = glm::dvec2(bounds.size_m());
    if (!(std::min(size_m.x, size_m.y) > 1e-9 * glm::length(bounds.size_m()))) {
      return Fault{"process.edge-on", "rotation_xyzw", "the mesh has no extent along the picture's width or height",
                   "turn the plane until the mesh faces it, or give the picture a size_m"};
    }
  }
  mapped.uvs.clear();
  for (const glm::dvec3& place_m : places_m) mapped.uvs.push_back((glm::dvec2(place_m) - low_m) / size_m);
  return mapped;
}

Result<Mesh> mapped_by_projector(const Mesh& mesh, const UvProjectorStep& step, const glm::dmat4& room_from_mesh) {
  const glm::dmat4 projector_from_mesh = step.pose.inverse().matrix() * room_from_mesh;
  if (const Status front = in_front(mesh, projector_from_mesh); !front) return front.fault();
  CutMesh cut(mesh, step, projector_from_mesh);
  while (cut.cut()) {
    if (cut.triangles() <= most_processed_triangles) continue;
    return Fault{"process.too-large", "width_px",
                 std::to_string(mesh.triangles.size()) + " triangles become more than " +
                     std::to_string(most_processed_triangles),
                 "use fewer pixels, or move the projector away from the mesh"};
  }
  return cut.take();
}

}  // namespace focalstage
