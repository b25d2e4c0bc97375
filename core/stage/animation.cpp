#include "core/stage/animation.h"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "core/base/rigid.h"
#include "core/stage/interpolate.h"

namespace focalstage {
namespace {

using Interpolation = AnimationChannel::Interpolation;
using Target = AnimationChannel::Target;

glm::dquat rotation_from(const glm::dvec4& xyzw) { return {xyzw.w, xyzw.x, xyzw.y, xyzw.z}; }

Between between_keys(const AnimationChannel& channel, double time_s) {
  return between(channel.times_s.size(), time_s, [&](std::size_t i) { return channel.times_s[i]; });
}

/// A cubic with given values and slopes at both ends (glTF 2.0, appendix C.4).
template <class Value>
Value hermite(double s, double step_s, const Value& value_from, const Value& slope_from, const Value& slope_to,
              const Value& value_to) {
  const double s2 = s * s;
  const double s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * value_from + step_s * (s3 - 2 * s2 + s) * slope_from + (3 * s2 - 2 * s3) * value_to +
         step_s * (s3 - s2) * slope_to;
}

/// `element(i)` is the i-th of the channel's values and tangents.
template <class Element>
auto cubic_at(const AnimationChannel& channel, const Between& at, const Element& element) {
  const double step_s = channel.times_s[at.to] - channel.times_s[at.from];
  return hermite(at.share, step_s, element(3 * at.from + 1), element(3 * at.from + 2), element(3 * at.to),
                 element(3 * at.to + 1));
}

glm::dvec4 value_at(const AnimationChannel& channel, double time_s) {
  const Between at = between_keys(channel, time_s);
  const bool cubic = channel.interpolation == Interpolation::cubic;
  const auto key = [&](std::size_t i) { return channel.values[cubic ? 3 * i + 1 : i]; };
  if (at.from == at.to || channel.interpolation == Interpolation::step) return key(at.from);
  if (cubic) return cubic_at(channel, at, [&](std::size_t i) { return channel.values[i]; });
  if (channel.target == Target::rotation) {
    const glm::dquat q = slerp(rotation_from(key(at.from)), rotation_from(key(at.to)), at.share);
    return {q.x, q.y, q.z, q.w};
  }
  return key(at.from) + at.share * (key(at.to) - key(at.from));
}

void drive(NodePose& pose, const AnimationChannel& channel, double time_s) {
  const glm::dvec4 value = value_at(channel, time_s);
  switch (channel.target) {
    case Target::translation:
      pose.translation = glm::dvec3(value);
      break;
    case Target::scale:
      pose.scale = glm::dvec3(value);
      break;
    case Target::rotation:
      // A cubic can pass through zero between opposite keys; there the file's own rotation is as good as any.
      if (glm::dot(value, value) > 0.0) pose.rotation = glm::normalize(rotation_from(value));
      break;
    case Target::morph_weights:
      break;  // no part of a pose
  }
}

/// Number `k` of the weights.
double morph_weight_at(const AnimationChannel& channel, const Between& at, std::size_t count, std::size_t k) {
  const bool cubic = channel.interpolation == Interpolation::cubic;
  const auto element = [&](std::size_t i) { return channel.morph_weights[i * count + k]; };
  const auto key = [&](std::size_t i) { return element(cubic ? 3 * i + 1 : i); };
  if (at.from == at.to || channel.interpolation == Interpolation::step) return key(at.from);
  if (cubic) return cubic_at(channel, at, element);
  return key(at.from) + at.share * (key(at.to) - key(at.from));
}

}  // namespace

std::vector<NodePose> poses_at(const Model& model, double time_s) {
  std::vector<NodePose> poses;
  poses.reserve(model.nodes.size());
  for (const Node& node : model.nodes) poses.push_back(node.pose);
  for (const Animation& animation : model.animations) {
    for (const AnimationChannel& channel : animation.channels) {
      if (channel.node < 0 || channel.times_s.empty() || channel.target == Target::morph_weights) continue;
      drive(poses[static_cast<std::size_t>(channel.node)], channel, time_s);
    }
  }
  return poses;
}

std::vector<std::vector<double>> morph_weights_at(const Model& model, double time_s) {
  std::vector<std::vector<double>> weights;
  weights.reserve(model.nodes.size());
  for (const Node& node : model.nodes) weights.push_back(node.morph_weights);
  for (const Animation& animation : model.animations) {
    for (const AnimationChannel& channel : animation.channels) {
      if (channel.target != Target::morph_weights || channel.node < 0 || channel.times_s.empty()) continue;
      std::vector<double>& driven = weights[static_cast<std::size_t>(channel.node)];
      const Between at = between_keys(channel, time_s);
      for (std::size_t k = 0; k < driven.size(); ++k) driven[k] = morph_weight_at(channel, at, driven.size(), k);
    }
  }
  return weights;
}

std::vector<glm::dmat4> model_from_nodes(const Model& model, const std::vector<NodePose>& poses) {
  std::vector<glm::dmat4> matrices;
  matrices.reserve(model.nodes.size());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const NodePose& pose = poses[i];
    const std::optional<glm::dmat4>& matrix = model.nodes[i].matrix;
    const glm::dmat4 parent_from_node =
        matrix ? *matrix : glm::scale(Rigid{pose.translation, pose.rotation}.matrix(), pose.scale);
    const int parent = model.nodes[i].parent;
    matrices.push_back(parent < 0 ? parent_from_node : matrices[static_cast<std::size_t>(parent)] * parent_from_node);
  }
  return matrices;
}

}  // namespace focalstage
