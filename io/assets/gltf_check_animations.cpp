#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include "io/assets/gltf_check.h"

namespace focalstage {
namespace {

/// What a channel drives: how its values are stored, and how many numbers one value is.
struct Driven {
  int type;
  unsigned storage;
  std::size_t accessor_elements = 1;  ///< of one value
};

constexpr unsigned float_or_fraction =
    stored_float | stored_i8_fraction | stored_u8_fraction | stored_i16_fraction | stored_u16_fraction;

class AnimationChecker {
 public:
  explicit AnimationChecker(const GltfDocument& document) : document_(document) {}

  Status check(std::size_t index) {
    const tinygltf::Animation& animation = document_.gltf.animations[index];
    std::set<std::pair<int, std::string>> driven;
    for (std::size_t k = 0; k < animation.channels.size(); ++k) {
      const tinygltf::AnimationChannel& channel = animation.channels[k];
      where_ = document_.at("animations", index) + "/channels/" + std::to_string(k);
      if (Status status = check_channel(animation, channel); !status) return status;
      if (!driven.emplace(channel.target_node, channel.target_path).second) {
        return invalid_asset(where_, "two channels drive the same property");
      }
    }
    return {};
  }

 private:
  Status check_channel(const tinygltf::Animation& animation, const tinygltf::AnimationChannel& channel) {
    if (!is_one_of(channel.sampler, animation.samplers.size())) {
      return invalid_asset(where_ + "/sampler", "there is no such sampler");
    }
    if (!is_one_of(channel.target_node, document_.gltf.nodes.size())) {
      return invalid_asset(where_ + "/target/node", "there is no such node");
    }
    const tinygltf::Node& node = document_.gltf.nodes[static_cast<std::size_t>(channel.target_node)];
    const Result<Driven> driven = driven_by(channel.target_path, node);
    if (!driven) return driven.fault();
    const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(channel.sampler)];
    const std::string& interpolation = sampler.interpolation;
    if (interpolation != "LINEAR" && interpolation != "STEP" && interpolation != "CUBICSPLINE") {
      return invalid_asset(where_, "its sampler's interpolation is none of glTF's");
    }
    if (Status status = check_times(sampler); !status) return status;
    return check_values(sampler, *driven, channel.target_path == "rotation");
  }

  Result<Driven> driven_by(std::string_view path, const tinygltf::Node& node) const {
    if (path == "weights") {
      const auto mesh = static_cast<std::size_t>(node.mesh);
      const std::size_t targets = node.mesh < 0 ? 0 : morph_targets(document_.gltf.meshes[mesh]);
      if (targets == 0) return invalid_asset(where_ + "/target/node", "the node has no morph targets");
      return Driven{TINYGLTF_TYPE_SCALAR, float_or_fraction, targets};
    }
    if (path != "translation" && path != "rotation" && path != "scale") {
      return unsupported_asset(
          where_ + "/target/path",
          "only translation, rotation, scale and weights are animated, not " + std::string(path.substr(0, 40)),
          "export without it");
    }
    if (!node.matrix.empty()) return invalid_asset(where_ + "/target/node", "an animated node has a matrix");
    if (path == "rotation") return Driven{TINYGLTF_TYPE_VEC4, float_or_fraction};
    return Driven{TINYGLTF_TYPE_VEC3, stored_float};
  }

  Status check_times(const tinygltf::AnimationSampler& sampler) {
    const tinygltf::Accessor* input = accessor_at(document_, sampler.input);
    if (input == nullptr || input->type != TINYGLTF_TYPE_SCALAR || storage_of(*input) != stored_float) {
      return invalid_asset(where_, "its sampler's input is no accessor of floats");
    }
    if (Status status = take(input->count); !status) return status;
    GltfElements times(document_, *input);
    double before_s = -1.0;
    for (std::size_t i = 0; i < input->count; ++i) {
      times.next();
      const double time_s = times.number(0);
      if (time_s < 0.0 || time_s <= before_s) {
        return invalid_asset(where_, "its times are negative or do not ascend");
      }
      before_s = time_s;
    }
    return {};
  }

  Status check_values(const tinygltf::AnimationSampler& sampler, const Driven& driven, bool rotates) {
    const tinygltf::Accessor* output = accessor_at(document_, sampler.output);
    if (output == nullptr) return invalid_asset(where_, "its sampler's output is no accessor");
    if (output->type != driven.type || (storage_of(*output) & driven.storage) == 0) {
      return invalid_asset(where_, "its sampler's output has not the type of what it drives");
    }
    const bool cubic = sampler.interpolation == "CUBICSPLINE";
    const std::size_t times = accessor_at(document_, sampler.input)->count;
    if (output->count != times * driven.accessor_elements * (cubic ? 3 : 1)) {
      return invalid_asset(where_, "its sampler has not as many values as times");
    }
    if (Status status = take(output->count); !status) return status;
    return rotates ? check_rotations(*output, cubic) : Status{};
  }

  Status check_rotations(const tinygltf::Accessor& output, bool cubic) const {
    GltfElements rotations(document_, output);
    for (std::size_t i = 0; i < output.count; ++i) {
      rotations.next();
      if (cubic && i % 3 != 1) continue;  // a tangent
      double square = 0.0;
      for (std::size_t k = 0; k < 4; ++k) square += rotations.number(k) * rotations.number(k);
      if (!(square > 0.81 && square < 1.21)) return invalid_asset(where_, "a rotation is no unit quaternion");
    }
    return {};
  }

  /// Many channels may name one accessor: what they hold together is bounded, too.
  Status take(std::size_t count) {
    values_ += count;
    if (values_ <= most_vertices) return {};
    return Fault{"asset.too-large", where_, "the animations hold more than 2^24 values", "shorten them"};
  }

  const GltfDocument& document_;
  std::string where_;  ///< the channel at hand
  std::size_t values_ = 0;
};

}  // namespace

Status check_gltf_animations(const GltfDocument& document) {
  AnimationChecker checker(document);
  for (std::size_t i = 0; i < document.gltf.animations.size(); ++i) {
    if (Status status = checker.check(i); !status) return status;
  }
  return {};
}

}  // namespace focalstage
