#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace focalstage {

/// An indexed triangle soup: it can hold what a half-edge mesh can't (non-manifold edges, loose triangles).
/// `normals`, `uvs` and `colors` are either empty or one per position. Counter-clockwise is the front.
struct Mesh {
  std::vector<glm::dvec3> positions_m;
  std::vector<glm::dvec3> normals;
  std::vector<glm::dvec2> uvs;  ///< (0,0) is the lower left corner of the picture
  std::vector<glm::uvec3> triangles;
  std::vector<glm::dvec3> colors{};  ///< linear RGB that multiplies the material's

  bool operator==(const Mesh&) const = default;
};

}  // namespace focalstage
