#include "core/mesh/deform.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace focalstage {
namespace {

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void morph(Mesh& mesh, const MorphTarget& target, double weight) {
  if (weight == 0.0) return;
  const bool has_normals = !mesh.normals.empty() && !target.normal_offsets.empty();
  for (std::size_t k = 0; k < target.vertices.size(); ++k) {
    const std::uint32_t vertex = target.vertices[k];
    mesh.positions_m[vertex] += weight * target.offsets_m[k];
    if (has_normals) mesh.normals[vertex] += weight * target.normal_offsets[k];
  }
}

/// Where a vertex is carried: the sum of its joints' matrices, each by its share.
glm::dmat4 carried(const Deformation& deformation, std::size_t vertex, std::span<const glm::dmat4> mesh_from_joints) {
  glm::dmat4 sum(0.0);
  for (std::uint32_t k = deformation.first_share[vertex]; k < deformation.first_share[vertex + 1]; ++k) {
    const JointShare& share = deformation.shares[k];
    sum += share.weight * mesh_from_joints[share.joint];
  }
  return sum;
}

void carry(Mesh& mesh, const Deformation& deformation, std::span<const glm::dmat4> mesh_from_joints) {
  for (std::size_t i = 0; i < mesh.positions_m.size(); ++i) {
    const glm::dmat4 matrix = carried(deformation, i, mesh_from_joints);
    mesh.positions_m[i] = glm::dvec3(matrix * glm::dvec4(mesh.positions_m[i], 1.0));
    if (mesh.normals.empty()) continue;
    // Cofactors: the inverse transpose up to a factor, whose sign is that of a mirrored matrix.
    const glm::dmat3 m(matrix);
    const glm::dmat3 turn(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    mesh.normals[i] = turn * mesh.normals[i];
  }
}

/// Normals of unit length; what came to no direction or to no number is as it was.
void keep_sound(Mesh& mesh, const Mesh& before) {
  for (std::size_t i = 0; i < mesh.positions_m.size(); ++i) {
    if (!is_finite(mesh.positions_m[i])) mesh.positions_m[i] = before.positions_m[i];
  }
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    const glm::dvec3& normal = mesh.normals[i];
    const double largest = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
    const bool has_direction = is_finite(normal) && largest > 0.0;
    mesh.normals[i] = has_direction ? glm::normalize(normal / largest) : before.normals[i];
  }
}

}  // namespace

Mesh deformed(const Mesh& mesh, const Deformation& deformation, std::span<const double> morph_weights,
              std::span<const glm::dmat4> mesh_from_joints) {
  Mesh moved = mesh;
  const std::size_t targets = std::min(deformation.targets.size(), morph_weights.size());
  for (std::size_t i = 0; i < targets; ++i) morph(moved, deformation.targets[i], morph_weights[i]);
  if (!mesh_from_joints.empty() && !deformation.first_share.empty()) carry(moved, deformation, mesh_from_joints);
  keep_sound(moved, mesh);
  return moved;
}

}  // namespace focalstage
