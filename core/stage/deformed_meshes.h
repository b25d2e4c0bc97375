#pragma once

#include <memory>
#include <vector>

#include <glm/mat4x4.hpp>

#include "core/mesh/model.h"

namespace focalstage {

/// All that decides a part's vertices at one moment.
struct Deformed {
  std::vector<double> morph_weights;
  std::vector<glm::dmat4> mesh_from_joints;  ///< empty: the part hangs on no skin

  bool operator==(const Deformed&) const = default;
};

/// The part's mesh in this state. As long as somebody holds what an earlier call gave, a part in the same state is the
/// same mesh at the same address: what compiles and draws takes another address for something that moved.
std::shared_ptr<const Mesh> deformed_mesh(const ModelPart& part, Deformed state);

}  // namespace focalstage
