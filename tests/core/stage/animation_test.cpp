#include "core/stage/animation.h"

#include <doctest/doctest.h>

#include <cmath>

#include <glm/geometric.hpp>

using namespace focalstage;

namespace {

Model one_node(AnimationChannel channel) {
  Model model;
  model.nodes.emplace_back();
  channel.node = 0;
  model.animations.push_back({"move", {std::move(channel)}});
  return model;
}

AnimationChannel channel(AnimationChannel::Target target, AnimationChannel::Interpolation interpolation) {
  AnimationChannel made;
  made.target = target;
  made.interpolation = interpolation;
  return made;
}

using Target = AnimationChannel::Target;
using Interpolation = AnimationChannel::Interpolation;

}  // namespace

TEST_CASE("a linear channel goes straight and holds at its ends") {
  AnimationChannel move = channel(Target::translation, Interpolation::linear);
  move.times_s = {1, 3};
  move.values = {{0, 0, 0, 0}, {4, 8, -2, 0}};
  const Model model = one_node(move);
  CHECK(poses_at(model, 0)[0].translation == glm::dvec3(0));
  CHECK(poses_at(model, 1.5)[0].translation == glm::dvec3(1, 2, -0.5));
  CHECK(poses_at(model, 99)[0].translation == glm::dvec3(4, 8, -2));
}

TEST_CASE("a step channel jumps at its keys") {
  AnimationChannel grow = channel(Target::scale, Interpolation::step);
  grow.times_s = {0, 1};
  grow.values = {{1, 1, 1, 0}, {2, 3, 4, 0}};
  const Model model = one_node(grow);
  CHECK(poses_at(model, 0.999)[0].scale == glm::dvec3(1));
  CHECK(poses_at(model, 1.0)[0].scale == glm::dvec3(2, 3, 4));
}

TEST_CASE("a rotation channel turns along the shorter arc, as a unit quaternion") {
  AnimationChannel turn = channel(Target::rotation, Interpolation::linear);
  const double s = std::sqrt(0.5);
  turn.times_s = {0, 1};
  turn.values = {{0, 0, 0, 1}, {0, -s, 0, -s}};  // 90 degrees about Y, written the other way round
  const glm::dquat half = poses_at(one_node(turn), 0.5)[0].rotation;
  CHECK(std::abs(half.y) == doctest::Approx(std::sin(0.39269908169872414)).epsilon(1e-14));
  CHECK(glm::length(half) == doctest::Approx(1.0).epsilon(1e-15));
}

TEST_CASE("a cubic channel has its keys' values and slopes") {
  AnimationChannel move = channel(Target::translation, Interpolation::cubic);
  move.times_s = {0, 2};
  // x(t) = t^3 on [0, 2]: values 0 and 8, slopes 0 and 12. y = t: slopes 1.
  move.values = {{}, {0, 0, 0, 0}, {0, 1, 0, 0}, {12, 1, 0, 0}, {8, 2, 0, 0}, {}};
  const Model model = one_node(move);
  for (const double t : {0.0, 0.3, 1.0, 1.7, 2.0}) {
    CHECK(poses_at(model, t)[0].translation.x == doctest::Approx(t * t * t).epsilon(1e-14));
    CHECK(poses_at(model, t)[0].translation.y == doctest::Approx(t).epsilon(1e-14));
  }
}

TEST_CASE("what no channel drives stays as the file has it, and children follow their parents") {
  Model model;
  model.nodes.resize(3);
  model.nodes[0].pose.translation = {1, 0, 0};
  model.nodes[0].pose.scale = {2, 2, 2};
  model.nodes[1].parent = 0;
  model.nodes[1].pose.translation = {0, 3, 0};
  const double s = std::sqrt(0.5);
  model.nodes[1].pose.rotation = glm::dquat(s, 0, 0, s);  // 90 degrees about Z
  model.nodes[2].parent = 1;
  model.nodes[2].pose.translation = {1, 0, 0};
  const auto matrices = model_from_nodes(model, poses_at(model, 0));
  // From the leaf: (1,0,0) turns to (0,1,0), moves to (0,4,0), doubles to (0,8,0), moves to (1,8,0).
  CHECK(glm::length(glm::dvec3(matrices[2] * glm::dvec4(0, 0, 0, 1)) - glm::dvec3(1, 8, 0)) < 1e-14);
}

TEST_CASE("weights of morph targets step, go straight and follow cubics, each node its own") {
  Model model;
  model.nodes.resize(2);
  model.nodes[0].morph_weights = {0.5, 0.25};
  model.nodes[1].morph_weights = {9};
  AnimationChannel weigh = channel(Target::morph_weights, Interpolation::linear);
  weigh.node = 0;
  weigh.times_s = {1, 3};
  weigh.morph_weights = {0, 1, 4, -1};
  model.animations.push_back({"weigh", {weigh}});
  CHECK(morph_weights_at(model, 1.5)[0] == std::vector<double>{1, 0.5});
  CHECK(morph_weights_at(model, 0)[0] == std::vector<double>{0, 1});
  CHECK(morph_weights_at(model, 7)[0] == std::vector<double>{4, -1});
  CHECK(morph_weights_at(model, 1.5)[1] == std::vector<double>{9});
  AnimationChannel& stepping = model.animations[0].channels[0];
  stepping.interpolation = Interpolation::step;
  CHECK(morph_weights_at(model, 2.999)[0] == std::vector<double>{0, 1});
  stepping.interpolation = Interpolation::cubic;
  stepping.times_s = {0, 2};
  // x = t^3 and y = t: in-tangents, values, out-tangents of both weights at each key.
  stepping.morph_weights = {7, 7, 0, 0, 0, 1, 12, 1, 8, 2, 7, 7};
  for (const double t : {0.0, 0.3, 1.0, 1.7, 2.0}) {
    CHECK(morph_weights_at(model, t)[0][0] == doctest::Approx(t * t * t).epsilon(1e-14));
    CHECK(morph_weights_at(model, t)[0][1] == doctest::Approx(t).epsilon(1e-14));
  }
  // Poses know nothing of them.
  CHECK(poses_at(model, 1)[0].translation == glm::dvec3(0));
}
