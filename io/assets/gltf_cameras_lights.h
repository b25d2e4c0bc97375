#pragma once

#include <vector>

#include "core/mesh/model.h"
#include "io/assets/gltf_accessors.h"
#include "io/assets/mesh_file.h"

namespace focalstage {

/// What a glTF's cameras and lights (KHR_lights_punctual) could become in a project, each as a finding whose remedy is
/// the edits that make it so: a camera the viewer or a projector, a light one of the project's. In the file's own
/// space, at rest. `nodes` are the file's in our order.
std::vector<Finding> cameras_and_lights(const GltfDocument& document, const std::vector<Node>& nodes,
                                        const std::vector<int>& node_of_gltf);

/// The light that stands at a node, -1 for none; not yet held to the file's list.
int light_of_node(const tinygltf::Node& node);

}  // namespace focalstage
