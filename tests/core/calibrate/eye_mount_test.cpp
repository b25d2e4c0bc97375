#include "core/calibrate/eye_mount.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include <glm/geometric.hpp>

using namespace focalstage;
using doctest::Approx;

namespace {

// Glasses whose tracked body is turned by some degrees against the head and sits above the nose.
const glm::dquat mounted = glm::normalize(glm::dquat(0.98, 0.0, 0.12, 0.05));
const Rigid body_from_viewer{{0.004, -0.035, 0.021}, mounted};
const glm::dvec3 mark_m{0.02, 1.25, -0.3};

/// An eye's centre in the body's axes, 31 mm aside and 10.5 mm behind the viewer's place.
glm::dvec3 centre_m(Side eye) { return body_from_viewer.point({eye == Side::left ? -0.031 : 0.031, 0.0, 0.0105}); }

/// Heads at 0.35 m before the mark, turned each another way, with every eye in turn: the spot is where the way from the
/// eye through the mark meets the wall z = -0.7; noise moves the eye.
std::vector<Sighting> sightings_of(double noise_m, std::uint32_t seed, double turn_rad = 0.25) {
  std::mt19937 random(seed);
  std::normal_distribution<double> error(0.0, 1.0);
  std::vector<Sighting> all;
  for (int i = 0; i < 16; ++i) {
    Sighting sighting;
    sighting.eye = i % 2 == 0 ? Side::left : Side::right;
    const double around = 2.4 * i;
    sighting.world_from_body = {
        {0.05 * std::sin(1.7 * i), 1.2 + 0.04 * std::cos(2.1 * i), 0.05 + 0.02 * std::sin(0.9 * i)},
        glm::angleAxis(turn_rad, glm::dvec3(std::cos(around), std::sin(around), 0.0)) * glm::conjugate(mounted)};
    const glm::dvec3 off{error(random), error(random), error(random)};
    const glm::dvec3 eye_m = sighting.world_from_body.point(centre_m(sighting.eye)) + noise_m * off;
    sighting.mark_m = mark_m;
    sighting.spot_m = eye_m + (mark_m - eye_m) * ((-0.7 - eye_m.z) / (mark_m.z - eye_m.z));
    all.push_back(sighting);
  }
  return all;
}

std::string code_of(const std::vector<Sighting>& sightings) {
  const auto found = eye_mount(sightings, mounted);
  return found ? "" : found.fault().code;
}

}  // namespace

TEST_CASE("eyes are found in the body's axes from ways that run through them") {
  const auto found = eye_mount(sightings_of(0.0, 1), mounted);
  if (!found) FAIL(describe(found.fault()));
  CHECK(found->rms_mm < 1e-9);
  CHECK(found->interpupillary_mm == Approx(62.0));
  for (const Side eye : both_sides) CHECK(glm::distance(found->centre_m[eye], centre_m(eye)) < 1e-9);
  CHECK(glm::distance(found->body_from_viewer.position_m, body_from_viewer.position_m) < 1e-9);
  CHECK(std::abs(glm::dot(found->body_from_viewer.rotation, mounted)) == Approx(1.0));
}

TEST_CASE("a body that is turned otherwise than was said is turned to both eyes") {
  const glm::dquat said = glm::angleAxis(0.2, glm::dvec3(0.0, 1.0, 0.0)) * mounted;
  const auto found = eye_mount(sightings_of(0.0, 1), said);
  if (!found) FAIL(describe(found.fault()));
  const glm::dvec3 axis = found->body_from_viewer.direction({1.0, 0.0, 0.0});
  CHECK(glm::distance(axis, mounted * glm::dvec3(1.0, 0.0, 0.0)) < 1e-9);
}

TEST_CASE("with noise eyes are found within what is said of them") {
  constexpr int times = 300;
  int within_one = 0, within_two = 0, distance_within_two = 0;
  double rms_mm = 0.0;
  for (std::uint32_t seed = 0; seed < times; ++seed) {
    const auto found = eye_mount(sightings_of(0.001, seed), mounted);
    REQUIRE(found);
    rms_mm += found->rms_mm / times;
    for (const Side eye : both_sides) {
      const glm::dvec3 off_m = found->centre_m[eye] - centre_m(eye);
      for (int axis = 0; axis < 3; ++axis) {
        within_one += std::abs(off_m[axis]) <= found->uncertainty_m[eye][axis] ? 1 : 0;
        within_two += std::abs(off_m[axis]) <= 2.0 * found->uncertainty_m[eye][axis] ? 1 : 0;
      }
    }
    const double apart_off_mm = std::abs(found->interpupillary_mm - 62.0);
    distance_within_two += apart_off_mm <= 2.0 * found->interpupillary_uncertainty_mm ? 1 : 0;
  }
  CHECK(within_one > 6 * times * 60 / 100);  // 68 % less what few equations cost
  CHECK(within_one < 6 * times * 76 / 100);
  CHECK(within_two > 6 * times * 90 / 100);
  CHECK(distance_within_two > times * 90 / 100);
  // Two of three directions of the noise lie across the way; 26 equations of 32 are free.
  CHECK(rms_mm == Approx(std::sqrt(2.0 * 26.0 / 32.0)).epsilon(0.05));
}

TEST_CASE("one wrong sighting shows in the residuals and is named") {
  std::vector<Sighting> wrong = sightings_of(0.0002, 3);
  wrong[5].name = "head left";
  wrong[5].spot_m.x += 0.03;
  const auto found = eye_mount(wrong, mounted);
  REQUIRE(found);
  CHECK(found->worst == 5);
  CHECK(found->rms_mm > 2.0);
  CHECK(sighting_label(wrong, found->worst) == "6 (head left)");
}

TEST_CASE("what cannot tell where the eyes are is refused") {
  const std::vector<Sighting> good = sightings_of(0.0002, 1);
  CHECK(code_of(good).empty());
  CHECK(code_of({good.begin(), good.begin() + 7}) == "sightings.few");  // three with the right eye
  std::vector<Sighting> left_alone;
  for (const Sighting& sighting : good) {
    if (sighting.eye == Side::left) left_alone.push_back(sighting);
  }
  CHECK(code_of(left_alone) == "sightings.few");
  CHECK(code_of({}) == "sightings.few");

  std::vector<Sighting> bad = good;
  bad[2].mark_m.y = std::numeric_limits<double>::quiet_NaN();
  CHECK(code_of(bad) == "sightings.finite");
  bad = good;
  bad[2].world_from_body.rotation = {0.0, 0.0, 0.0, 0.0};
  CHECK(code_of(bad) == "sightings.finite");
  bad = good;
  bad[4].spot_m = bad[4].mark_m + glm::dvec3(0.0, 0.0, -0.04);
  CHECK(code_of(bad) == "sightings.near");
  bad = good;
  std::swap(bad[4].spot_m, bad[4].mark_m);
  CHECK(code_of(bad) == "sightings.behind");
  bad = good;
  for (Sighting& sighting : bad) sighting.eye = sighting.eye == Side::left ? Side::right : Side::left;
  CHECK(code_of(bad) == "sightings.eyes");

  // A head that never turns and looks at the mark straight on: the ways run alike in the glasses.
  std::vector<Sighting> still = sightings_of(0.0, 1, 0.0);
  for (std::size_t i = 0; i < still.size(); ++i) {
    const glm::dvec3 eye_m = mark_m + glm::dvec3(0.0, 0.0, 0.3 + 0.01 * static_cast<double>(i));
    still[i].world_from_body.position_m = eye_m - still[i].world_from_body.direction(centre_m(still[i].eye));
    still[i].spot_m = mark_m + glm::dvec3(0.0, 0.0, -0.4);
  }
  CHECK(code_of(still) == "sightings.parallel");
}
