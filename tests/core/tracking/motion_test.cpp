#include "core/tracking/motion.h"

#include <cmath>
#include <numbers>
#include <random>

#include <doctest/doctest.h>

using namespace focalstage;
using doctest::Approx;

namespace {

constexpr double rate_hz = 240.0;
constexpr double radius_m = 0.2;
constexpr double omega = 2.0;  // rad/s
constexpr double climb_m_s = 0.1;

double angle_between(const glm::dquat& a, const glm::dquat& b) {
  return glm::length(rotation_vector(glm::conjugate(a) * b));
}

/// Round the vertical and up, facing the way it goes.
Rigid helix(double t) {
  return {{radius_m * std::cos(omega * t), climb_m_s * t, -radius_m * std::sin(omega * t)},
          glm::angleAxis(omega * t, glm::dvec3(0, 1, 0))};
}

/// Seen 4 ms ago by a tracker whose clock shows something else.
PoseSample sample_of(double t, const Rigid& pose) { return {t + 1000.0, t, true, pose}; }

Motion followed(double until_s, Rigid (*path)(double), const MotionLimits& limits = {}) {
  Motion motion(limits);
  const int count = static_cast<int>(until_s * rate_hz);
  for (int k = 0; k <= count; ++k) motion.add(sample_of(k / rate_hz, path(k / rate_hz)));
  return motion;
}

double last_s(double until_s) { return static_cast<int>(until_s * rate_hz) / rate_hz; }

}  // namespace

TEST_CASE("rotation vectors and rotations are each other's inverse") {
  for (const glm::dvec3& v : {glm::dvec3(0.0), glm::dvec3(1e-14, 0, 0), glm::dvec3(0.3, -0.2, 0.9),
                              glm::dvec3(0, std::numbers::pi - 1e-6, 0)}) {
    CHECK(glm::distance(rotation_vector(rotation_by(v)), v) < 1e-9);
    CHECK(glm::distance(rotation_vector(-rotation_by(v)), v) < 1e-9);
  }
  CHECK(glm::length(rotation_vector({0, 0, 0, 1})) == Approx(std::numbers::pi));
}

TEST_CASE("a helix is predicted to within what its acceleration allows, a turn exactly") {
  const MotionLimits limits;
  const double acceleration = radius_m * omega * omega;
  for (const double begun_s : {0.3, 0.71, 2.0}) {
    const Motion motion = followed(begun_s, helix);
    const double now = last_s(begun_s);
    for (const double ahead : {0.0, 0.01, 0.03, 0.06, 0.1}) {
      const auto predicted = motion.at(now + ahead);
      REQUIRE(predicted);
      const Rigid truth = helix(now + ahead);
      const double bound = 0.5 * acceleration * ahead * (ahead + limits.window_s);
      const double off = glm::distance(predicted->position_m, truth.position_m);
      CHECK(off <= bound + 1e-12);
      // Without prediction it would be off by the way it goes meanwhile.
      if (ahead > 0.0) CHECK(off < 0.35 * std::hypot(radius_m * omega, climb_m_s) * ahead);
      CHECK(angle_between(predicted->rotation, truth.rotation) < 1e-9);
    }
  }
}

TEST_CASE("a straight line is predicted exactly, but no further than 150 ms") {
  const auto line = [](double t) -> Rigid { return {{0.5 * t, 1.0, -t}, {}}; };
  const Motion motion = followed(1.0, line);
  CHECK(glm::distance(motion.at(1.1)->position_m, line(1.1).position_m) < 1e-12);
  CHECK(glm::distance(motion.at(5.0)->position_m, line(1.15).position_m) < 1e-12);
  CHECK(glm::distance(motion.at(0.2)->position_m, line(1.0).position_m) < 1e-12);
}

TEST_CASE("what stands still stays still") {
  const auto still = [](double) -> Rigid { return {{0.1, 0.2, 0.3}, glm::angleAxis(0.7, glm::dvec3(0, 0, 1))}; };
  const Motion motion = followed(1.0, still);
  CHECK(glm::distance(motion.at(1.1)->position_m, still(0).position_m) < 1e-15);
  CHECK(angle_between(motion.at(1.1)->rotation, still(0).rotation) < 1e-12);
}

// The slope of n values with noise s, evenly over a time T, has a standard deviation of s sqrt(12 / n) / T.
TEST_CASE("noise moves a still thing by no more than the window lets through") {
  const double noise_m = 1e-4;
  std::mt19937 random(4);
  std::normal_distribution<double> error(0.0, noise_m);
  Motion motion;
  double square_sum = 0.0;
  const int count = 4000;
  for (int k = 0; k < count; ++k) {
    motion.add(sample_of(k / rate_hz, {{error(random), 0.0, 0.0}, {}}));
    if (k > 20) square_sum += std::pow(motion.at(k / rate_hz + 0.1)->position_m.x, 2);
  }
  const double n = 0.05 * rate_hz + 1.0;
  const double slope = noise_m * std::sqrt(12.0 / n) / 0.05;
  CHECK(std::sqrt(square_sum / (count - 21)) == Approx(std::hypot(noise_m, 0.1 * slope)).epsilon(0.25));
}

TEST_CASE("a jump is no velocity; what comes after it is") {
  Motion motion = followed(0.5, [](double t) -> Rigid { return {{t, 0, 0}, {}}; });
  const double jump_s = last_s(0.5) + 1.0 / rate_hz;
  motion.add(sample_of(jump_s, {{2.0, 0, 0}, {}}));
  CHECK(motion.at(jump_s + 0.1)->position_m.x == 2.0);
  const double after_s = jump_s + 1.0 / rate_hz;
  motion.add(sample_of(after_s, {{2.0 + 0.3 / rate_hz, 0, 0}, {}}));
  CHECK(motion.at(after_s + 0.1)->position_m.x == Approx(2.0 + 0.3 / rate_hz + 0.03));

  Motion turned = followed(0.5, helix);
  turned.add(sample_of(jump_s, {helix(jump_s).position_m, glm::angleAxis(2.5, glm::dvec3(1, 0, 0))}));
  CHECK(glm::distance(turned.at(jump_s + 0.1)->position_m, helix(jump_s).position_m) < 1e-15);
}

TEST_CASE("where it is not tracked there is no pose, and after that no velocity of before") {
  Motion motion = followed(0.5, [](double t) -> Rigid { return {{t, 0, 0}, {}}; });
  const double lost_s = last_s(0.5) + 1.0 / rate_hz;
  motion.add({lost_s + 1000.0, lost_s, false, {}});
  CHECK_FALSE(motion.at(lost_s));
  motion.add(sample_of(lost_s + 1.0 / rate_hz, {{0.6, 0, 0}, {}}));
  CHECK(motion.at(lost_s + 0.1)->position_m.x == 0.6);
  CHECK_FALSE(Motion().at(0.0));
}

TEST_CASE("gaps and clocks that go back end a motion; what is no newer changes nothing") {
  const auto line = [](double t) -> Rigid { return {{t, 0, 0}, {}}; };
  Motion gap = followed(0.5, line);
  gap.add(sample_of(0.75, line(0.75)));
  CHECK(gap.at(0.85)->position_m.x == 0.75);

  Motion again = followed(0.5, line);
  again.add(sample_of(0.49, {{7, 7, 7}, {}}));
  CHECK(again.at(0.6)->position_m.x == Approx(0.6));

  Motion restarted = followed(0.5, line);
  restarted.add({3.0, 0.51, true, line(0.1)});
  CHECK(restarted.at(0.6)->position_m.x == 0.1);
}
