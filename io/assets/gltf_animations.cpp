#include "io/assets/gltf_animations.h"

#include <optional>
#include <set>
#include <utility>

#include <glm/geometric.hpp>

#include "io/assets/mesh_file.h"

namespace focalstage {
namespace {

using Target = AnimationChannel::Target;
using Interpolation = AnimationChannel::Interpolation;

std::optional<Target> target_from(const std::string& path) {
  if (path == "translation") return Target::translation;
  if (path == "rotation") return Target::rotation;
  if (path == "scale") return Target::scale;
  return std::nullopt;
}

std::optional<Interpolation> interpolation_from(const std::string& name) {
  if (name == "LINEAR") return Interpolation::linear;
  if (name == "STEP") return Interpolation::step;
  if (name == "CUBICSPLINE") return Interpolation::cubic;
  return std::nullopt;
}

class AnimationReader {
 public:
  AnimationReader(const GltfDocument& document, const GltfNodes& nodes) : document_(document), nodes_(nodes) {}

  Result<std::vector<Animation>> read() {
    std::vector<Animation> animations;
    for (std::size_t i = 0; i < document_.gltf.animations.size(); ++i) {
      const tinygltf::Animation& from = document_.gltf.animations[i];
      Animation& animation = animations.emplace_back();
      animation.name = from.name;
      std::set<std::pair<int, Target>> driven;
      for (std::size_t k = 0; k < from.channels.size(); ++k) {
        const std::string where = document_.at("animations", i) + "/channels/" + std::to_string(k);
        Result<AnimationChannel> channel = read_channel(from, from.channels[k], where);
        if (!channel) return channel.fault();
        if (!driven.emplace(channel->node, channel->target).second) {
          return invalid_asset(where, "two channels drive the same property");
        }
        animation.channels.push_back(*std::move(channel));
      }
    }
    return animations;
  }

 private:
  Result<AnimationChannel> read_channel(const tinygltf::Animation& animation, const tinygltf::AnimationChannel& from,
                                        const std::string& where) {
    if (from.sampler < 0 || static_cast<std::size_t>(from.sampler) >= animation.samplers.size()) {
      return invalid_asset(where + "/sampler", "there is no such sampler");
    }
    if (from.target_node < 0 || static_cast<std::size_t>(from.target_node) >= nodes_.node_of_gltf.size()) {
      return invalid_asset(where + "/target/node", "there is no such node");
    }
    const std::optional<Target> target = target_from(from.target_path);
    if (!target) {
      return unsupported_asset(
          where + "/target/path",
          "only translation, rotation and scale are animated, not " + from.target_path.substr(0, 40),
          "export without it");
    }
    if (!document_.gltf.nodes[static_cast<std::size_t>(from.target_node)].matrix.empty()) {
      return invalid_asset(where + "/target/node", "an animated node has a matrix");
    }
    const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(from.sampler)];
    const std::optional<Interpolation> interpolation = interpolation_from(sampler.interpolation);
    if (!interpolation) return invalid_asset(where, "its sampler's interpolation is none of glTF's");
    AnimationChannel channel;
    channel.node = nodes_.node_of_gltf[static_cast<std::size_t>(from.target_node)];
    channel.target = *target;
    channel.interpolation = *interpolation;
    if (Status status = read_times(sampler, where, channel); !status) return status.fault();
    if (Status status = read_values(sampler, where, channel); !status) return status.fault();
    return channel;
  }

  Status read_times(const tinygltf::AnimationSampler& sampler, const std::string& where, AnimationChannel& channel) {
    const tinygltf::Accessor* input = accessor_at(document_, sampler.input);
    if (input == nullptr || input->type != TINYGLTF_TYPE_SCALAR ||
        input->componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
      return invalid_asset(where, "its sampler's input is no accessor of floats");
    }
    if (Status status = take(input->count, where); !status) return status;
    const Result<std::vector<glm::dvec4>> times = read_vectors(document_, sampler.input);
    if (!times) return times.fault();
    for (const glm::dvec4& time : *times) {
      if (time.x < 0.0 || (!channel.times_s.empty() && time.x <= channel.times_s.back())) {
        return invalid_asset(where, "its times are negative or do not ascend");
      }
      channel.times_s.push_back(time.x);
    }
    return {};
  }

  Status read_values(const tinygltf::AnimationSampler& sampler, const std::string& where, AnimationChannel& channel) {
    const tinygltf::Accessor* output = accessor_at(document_, sampler.output);
    if (output == nullptr) return invalid_asset(where, "its sampler's output is no accessor");
    const bool rotates = channel.target == Target::rotation;
    const bool is_float = output->componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
    if (output->type != (rotates ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3) ||
        !(is_float || (rotates && output->normalized))) {
      return invalid_asset(where, "its sampler's output has not the type of what it drives");
    }
    const bool cubic = channel.interpolation == Interpolation::cubic;
    if (output->count != channel.times_s.size() * (cubic ? 3 : 1)) {
      return invalid_asset(where, "its sampler has not as many values as times");
    }
    if (Status status = take(output->count, where); !status) return status;
    Result<std::vector<glm::dvec4>> values = read_vectors(document_, sampler.output);
    if (!values) return values.fault();
    channel.values = *std::move(values);
    for (std::size_t i = cubic ? 1 : 0; rotates && i < channel.values.size(); i += cubic ? 3 : 1) {
      const double length = glm::length(channel.values[i]);
      if (!(length > 0.9 && length < 1.1)) return invalid_asset(where, "a rotation is no unit quaternion");
      if (!cubic) channel.values[i] /= length;  // as floats rounded it; a cubic is made unit after interpolation
    }
    return {};
  }

  /// Many channels may name one accessor: what they hold together is bounded, too.
  Status take(std::size_t count, const std::string& where) {
    values_ += count;
    if (values_ <= most_vertices) return {};
    return Fault{"asset.too-large", where, "the animations hold more than 2^24 values", "shorten them"};
  }

  const GltfDocument& document_;
  const GltfNodes& nodes_;
  std::size_t values_ = 0;
};

}  // namespace

Result<std::vector<Animation>> read_gltf_animations(const GltfDocument& document, const GltfNodes& nodes) {
  return AnimationReader(document, nodes).read();
}

}  // namespace focalstage
