#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/mesh/deform.h"
#include "core/mesh/mesh.h"
#include "core/mesh/stored_picture.h"
#include "core/mesh/texture.h"

namespace focalstage {

/// What a mesh is made of, as far as the picture needs it.
struct Material {
  std::string name;
  glm::dvec3 base_color{1.0};              ///< linear RGB; multiplies the texture
  std::shared_ptr<const Texture> texture;  ///< none: base_color alone
  bool unlit = false;                      ///< KHR_materials_unlit: lights do not act on it
  double alpha_cutoff = 0.0;               ///< what is less opaque in the texture is cut away; 0: nothing is

  bool operator==(const Material&) const = default;
};

/// One drawable of a node: a mesh of the model, its material (-1: plain white), and how its vertices move (null: they
/// do not).
struct ModelPart {
  std::shared_ptr<const Mesh> mesh;
  int material = -1;
  std::shared_ptr<const Deformation> deformation{};
};

/// Where a node stands in its parent, as what animations drive.
struct NodePose {
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 scale{1.0};
};

struct Node {
  std::string name;
  int parent = -1;  ///< an index smaller than the node's own, or -1
  NodePose pose;
  std::optional<glm::dmat4> matrix;  ///< in place of the pose, where the file has one: it may shear
  std::vector<ModelPart> parts;
  int skin = -1;                        ///< that carries the parts; they then stand in the model, not at the node
  std::vector<double> morph_weights{};  ///< of the parts' morph targets, as long as nothing drives them
};

/// Nodes that carry a mesh's vertices as its joints.
struct Skin {
  std::vector<int> joints;                  ///< nodes of the model
  std::vector<glm::dmat4> joint_from_mesh;  ///< of each joint, where the mesh was bound to it

  bool operator==(const Skin&) const = default;
};

/// One animated property of one node; `values` holds a quaternion as x y z w, a vector as x y z 0.
struct AnimationChannel {
  enum class Target { translation, rotation, scale, morph_weights };
  enum class Interpolation { step, linear, cubic };

  int node = -1;
  Target target = Target::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<double> times_s;
  std::vector<glm::dvec4> values;       ///< cubic: in-tangent, value, out-tangent for each time
  std::vector<double> morph_weights{};  ///< in place of `values`: each as many numbers as the node has weights
};

struct Animation {
  std::string name;
  std::vector<AnimationChannel> channels;
};

/// The content of one mesh or glTF file. Parents stand before their children in `nodes`.
struct Model {
  std::vector<Material> materials;
  std::vector<Node> nodes;
  std::vector<Animation> animations;
  std::vector<Skin> skins{};
};

/// Every file a project refers to, read once, by the path the project writes.
struct Assets {
  std::map<std::string, std::shared_ptr<const Model>> models;
  std::map<std::string, std::shared_ptr<const StoredPicture>> pictures{};  ///< each of a sequence by its own path
};

}  // namespace focalstage
