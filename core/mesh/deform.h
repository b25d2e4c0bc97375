#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/mesh/mesh.h"

namespace focalstage {

/// What a morph target adds, at weight 1, to the vertices that it moves.
struct MorphTarget {
  std::vector<std::uint32_t> vertices;     ///< ascending
  std::vector<glm::dvec3> offsets_m;       ///< one per vertex named
  std::vector<glm::dvec3> normal_offsets;  ///< empty, or one per vertex named

  bool operator==(const MorphTarget&) const = default;
};

/// How far a vertex hangs on one joint of a skin.
struct JointShare {
  std::uint32_t joint = 0;
  double weight = 0.0;

  bool operator==(const JointShare&) const = default;
};

/// How the vertices of one mesh move: morph targets first, then joints.
struct Deformation {
  std::vector<MorphTarget> targets;
  std::vector<JointShare> shares;          ///< a vertex's side by side; their weights sum to one
  std::vector<std::uint32_t> first_share;  ///< of each vertex, and an end; empty: the mesh hangs on no joints

  bool operator==(const Deformation&) const = default;
};

/// The mesh as the weights of its morph targets and the matrices of its joints have it (glTF 2.0, 3.7.2.2 and 3.7.3):
/// p' = sum_j w_j M_j (p + sum_t a_t d_t), normals by the same sum's inverse transpose. `mesh_from_joints` may be
/// empty: joints then carry nothing. A vertex that no finite number comes of stays where the mesh has it.
Mesh deformed(const Mesh& mesh, const Deformation& deformation, std::span<const double> morph_weights,
              std::span<const glm::dmat4> mesh_from_joints);

}  // namespace focalstage
