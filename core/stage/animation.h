#pragma once

#include <vector>

#include <glm/mat4x4.hpp>

#include "core/mesh/model.h"

namespace focalstage {

/// Every node's pose in its parent at `time_s`: as the file has it, or as its animations say. All of a file's
/// animations run on the stage's clock; where two drive the same property the later in the file wins. Before its first
/// and after its last key a channel holds.
std::vector<NodePose> poses_at(const Model& model, double time_s);

/// The weights of every node's morph targets at `time_s`, by the same rules.
std::vector<std::vector<double>> morph_weights_at(const Model& model, double time_s);

/// Each node's matrix in the model's space.
std::vector<glm::dmat4> model_from_nodes(const Model& model, const std::vector<NodePose>& poses);

}  // namespace focalstage
