#include "io/assets/gltf_animations.h"

#include <glm/geometric.hpp>

namespace focalstage {
namespace {

using Target = AnimationChannel::Target;
using Interpolation = AnimationChannel::Interpolation;

Target target_from(const std::string& path) {
  if (path == "rotation") return Target::rotation;
  if (path == "weights") return Target::morph_weights;
  return path == "scale" ? Target::scale : Target::translation;
}

Interpolation interpolation_from(const std::string& name) {
  if (name == "STEP") return Interpolation::step;
  return name == "CUBICSPLINE" ? Interpolation::cubic : Interpolation::linear;
}

AnimationChannel read_channel(const GltfDocument& document, const tinygltf::AnimationSampler& sampler,
                              const std::string& path) {
  AnimationChannel channel;
  channel.target = target_from(path);
  channel.interpolation = interpolation_from(sampler.interpolation);
  channel.times_s = read_numbers(document, sampler.input);
  if (channel.target == Target::morph_weights) {
    channel.morph_weights = read_numbers(document, sampler.output);
    return channel;
  }
  channel.values = read_vectors(document, sampler.output);
  if (channel.target == Target::rotation && channel.interpolation != Interpolation::cubic) {
    // As floats rounded it; a cubic is made unit after interpolation.
    for (glm::dvec4& rotation : channel.values) rotation = glm::normalize(rotation);
  }
  return channel;
}

}  // namespace

std::vector<Animation> read_gltf_animations(const GltfDocument& document, const GltfNodes& nodes) {
  std::vector<Animation> animations;
  for (const tinygltf::Animation& from : document.gltf.animations) {
    Animation& animation = animations.emplace_back();
    animation.name = from.name;
    for (const tinygltf::AnimationChannel& driven : from.channels) {
      const tinygltf::AnimationSampler& sampler = from.samplers[static_cast<std::size_t>(driven.sampler)];
      AnimationChannel& channel = animation.channels.emplace_back(read_channel(document, sampler, driven.target_path));
      channel.node = nodes.node_of_gltf[static_cast<std::size_t>(driven.target_node)];
    }
  }
  return animations;
}

}  // namespace focalstage
