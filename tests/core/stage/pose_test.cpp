#include <doctest/doctest.h>

#include <cmath>

#include <glm/gtc/quaternion.hpp>

#include "core/stage/interpolate.h"
#include "core/stage/stage.h"

using namespace focalstage;

namespace {

glm::dquat about_y(double deg) { return glm::angleAxis(glm::radians(deg), glm::dvec3(0, 1, 0)); }

double apart(const glm::dquat& a, const glm::dquat& b) { return std::min(glm::length(a - b), glm::length(a + b)); }

Keyframe key(double time_s, double x, double deg) {
  Keyframe frame;
  frame.time_s = time_s;
  frame.pose = {glm::dvec3(x, 0, 0), about_y(deg)};
  return frame;
}

}  // namespace

TEST_CASE("a rotation between two turns at constant speed along the shorter arc") {
  for (const double share : {0.0, 0.25, 0.5, 0.9, 1.0}) {
    CHECK(apart(slerp(about_y(10), about_y(110), share), about_y(10 + 100 * share)) < 1e-15);
    // The same rotation with the opposite sign must not send it the long way round.
    CHECK(apart(slerp(about_y(10), -about_y(110), share), about_y(10 + 100 * share)) < 1e-15);
    CHECK(apart(slerp(about_y(170), about_y(190), share), about_y(170 + 20 * share)) < 1e-15);
    CHECK(apart(slerp(about_y(5), about_y(5 + 1e-10), share), about_y(5)) < 1e-11);
  }
  CHECK(slerp(about_y(33), about_y(33), 0.5).y == doctest::Approx(about_y(33).y).epsilon(1e-15));
}

TEST_CASE("keys hold before the first and after the last, and meet each exactly") {
  Placement placement;
  placement.pose.position_m = {9, 9, 9};
  CHECK(pose_at(placement, 1.0).position_m == glm::dvec3(9, 9, 9));
  placement.keys = {key(1.0, 0, 0), key(2.0, 10, 90), key(4.0, 20, 90)};
  CHECK(pose_at(placement, 0.0) == placement.keys[0].pose);
  CHECK(pose_at(placement, 1.0) == placement.keys[0].pose);
  CHECK(pose_at(placement, 2.0) == placement.keys[1].pose);
  CHECK(pose_at(placement, 4.0) == placement.keys[2].pose);
  CHECK(pose_at(placement, 1e9) == placement.keys[2].pose);
  const Rigid between_first_two = pose_at(placement, 1.25);
  CHECK(between_first_two.position_m.x == doctest::Approx(2.5).epsilon(1e-15));
  CHECK(apart(between_first_two.rotation, about_y(22.5)) < 1e-15);
  CHECK(pose_at(placement, 3.0).position_m.x == doctest::Approx(15.0).epsilon(1e-15));
}

TEST_CASE("two keys at one time are a jump, and a tracked body stands where its placement says") {
  Placement placement;
  placement.track = "head";
  placement.keys = {key(0.0, 0, 0), key(1.0, 1, 0), key(1.0, 5, 0), key(2.0, 6, 0)};
  CHECK(pose_at(placement, 0.999999).position_m.x == doctest::Approx(0.999999));
  CHECK(pose_at(placement, 1.0).position_m.x == 5.0);
  CHECK(pose_at(placement, 1.5).position_m.x == doctest::Approx(5.5));
}
