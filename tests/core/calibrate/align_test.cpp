#include "core/calibrate/align.h"

#include <cmath>
#include <limits>
#include <random>

#include <doctest/doctest.h>

using namespace focalstage;
using doctest::Approx;

namespace {

const Rigid truth{{0.4, 1.2, -2.0}, glm::normalize(glm::dquat(0.8, 0.1, -0.5, 0.3))};

const std::vector<glm::dvec3> room{{0.0, 0.0, 0.0},  {1.0, 0.1, 0.0},   {0.1, 0.9, 0.2},
                                   {-0.3, 0.4, 1.1}, {0.7, -0.5, -0.8}, {-0.9, 0.2, -0.4}};

std::vector<PointPair> pairs_of(const std::vector<glm::dvec3>& points, double noise_m = 0.0, std::uint32_t seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> error(0.0, 1.0);
  std::vector<PointPair> pairs;
  for (const glm::dvec3& p : points) {
    const glm::dvec3 off{error(random), error(random), error(random)};
    pairs.push_back({"", p, truth.point(p) + noise_m * off});
  }
  return pairs;
}

double angle_between(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat d = glm::conjugate(a) * b;
  return 2.0 * std::atan2(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), std::abs(d.w));
}

std::string code_of(const std::vector<PointPair>& pairs) {
  const auto result = align(pairs);
  return result ? "" : result.fault().code;
}

}  // namespace

TEST_CASE("exact pairs give the transform, from three points on") {
  for (std::size_t count = 3; count <= room.size(); ++count) {
    const auto alignment = align(pairs_of({room.begin(), room.begin() + static_cast<std::ptrdiff_t>(count)}));
    REQUIRE(alignment);
    CHECK(glm::distance(alignment->world_from_tracker.position_m, truth.position_m) < 1e-12);
    CHECK(angle_between(alignment->world_from_tracker.rotation, truth.rotation) < 1e-12);
    CHECK(alignment->rms_mm < 1e-9);
    CHECK(alignment->worst_mm < 1e-9);
    CHECK(alignment->left_out_rms_mm.has_value() == (count > 3));
  }
}

TEST_CASE("points in one plane, and a turn by 180 degrees, are no trouble") {
  const std::vector<glm::dvec3> flat{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const glm::dquat& turn : {glm::dquat(0, 1, 0, 0), glm::dquat(0, 0, 1, 0), glm::dquat(0, 0, 0, 1)}) {
    const Rigid half{{0.1, 0.2, 0.3}, turn};
    std::vector<PointPair> pairs;
    for (const glm::dvec3& p : flat) pairs.push_back({"", p, half.point(p)});
    const auto alignment = align(pairs);
    REQUIRE(alignment);
    CHECK(angle_between(alignment->world_from_tracker.rotation, turn) < 1e-7);
    CHECK(alignment->rms_mm < 1e-9);
  }
}

// Fitzpatrick, West and Maurer, "Predicting error in rigid-body point-based registration", IEEE TMI 17(5), 1998: of n
// points with independent errors of s along each axis, the expected sum of squared residuals is s^2 (3 n - 6).
TEST_CASE("residuals are as large as the noise makes them, and no larger") {
  const double noise_m = 1e-3;
  const int trials = 2000;
  double square_sum = 0.0;
  double left_out_square_sum = 0.0;
  double turn_square_sum = 0.0;
  int refused = 0;
  for (std::uint32_t seed = 0; seed < trials; ++seed) {
    const auto alignment = align(pairs_of(room, noise_m, seed));
    if (!alignment) {
      CHECK(alignment.fault().code == "align.pair-off");
      ++refused;
      continue;
    }
    square_sum += alignment->rms_mm * alignment->rms_mm;
    left_out_square_sum += *alignment->left_out_rms_mm * *alignment->left_out_rms_mm;
    turn_square_sum += std::pow(angle_between(alignment->world_from_tracker.rotation, truth.rotation), 2);
    CHECK(alignment->worst_mm == alignment->residuals[alignment->worst].distance_mm);
  }
  const double n = static_cast<double>(room.size());
  const double done = trials - refused;
  CHECK(square_sum / done == Approx((3.0 * n - 6.0) / n).epsilon(0.03));
  // A pair that had no say: its own noise and that of the alignment.
  CHECK(left_out_square_sum / done > 3.0);
  CHECK(left_out_square_sum / done < 9.0);
  CHECK(std::sqrt(turn_square_sum / done) < 2e-3);
  CHECK(refused <= 8);  // 2 expected
}

TEST_CASE("too few, on a line, in one place, or no numbers: refused by name") {
  CHECK(code_of({}) == "align.few");
  CHECK(code_of(pairs_of({room[0], room[1]})) == "align.few");
  CHECK(code_of(pairs_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}})) == "align.collinear");
  CHECK(code_of(pairs_of({{0, 0, 0}, {1, 0.005, 0}, {2, 0, 0.005}, {3, 0, 0}})) == "align.collinear");
  CHECK(code_of(pairs_of({room[1], room[1], room[1]})) == "align.collinear");
  auto broken = pairs_of(room);
  broken[4].name = "lamp";
  broken[4].world_m.y = std::numeric_limits<double>::quiet_NaN();
  const auto refused = align(broken);
  REQUIRE_FALSE(refused);
  CHECK(refused.fault().code == "align.finite");
  CHECK(refused.fault().where == "pair 5 (lamp)");
  broken[4].world_m.y = std::numeric_limits<double>::infinity();
  CHECK(code_of(broken) == "align.finite");
}

TEST_CASE("a world on one line is refused though the tracker's points are not") {
  auto pairs = pairs_of(room);
  for (PointPair& pair : pairs) pair.world_m = {pair.tracker_m.x, 0.0, 0.0};
  const auto refused = align(pairs);
  REQUIRE_FALSE(refused);
  CHECK(refused.fault().code == "align.collinear");
  CHECK(refused.fault().where == "world");
}

TEST_CASE("a mirrored axis is told from bad measuring") {
  for (const double noise_m : {0.0, 1e-3, 5e-3}) {
    for (const int axis : {0, 1, 2}) {
      auto pairs = pairs_of(room, noise_m, 7);
      for (PointPair& pair : pairs) pair.tracker_m[axis] *= -1.0;
      CHECK(code_of(pairs) == "align.mirrored");
    }
  }
  CHECK(code_of(pairs_of(room, 5e-3, 7)).empty());
}

TEST_CASE("the one pair that lies is named, wherever it stands") {
  for (std::size_t liar = 0; liar < room.size(); ++liar) {
    auto pairs = pairs_of(room, 5e-4, 3);
    pairs[liar].name = "liar";
    pairs[liar].world_m += glm::dvec3(0.0, 0.03, -0.02);
    const auto refused = align(pairs);
    REQUIRE_FALSE(refused);
    CHECK(refused.fault().code == "align.pair-off");
    CHECK(refused.fault().where == "pair " + std::to_string(liar + 1) + " (liar)");
  }
}

TEST_CASE("without noise a lie of a hundredth of a millimetre is seen; rounding is none") {
  auto pairs = pairs_of(room);
  pairs[2].world_m.x += 1e-5;
  CHECK(code_of(pairs) == "align.pair-off");
  pairs[2].world_m.x -= 1e-5 - 1e-10;
  CHECK(code_of(pairs).empty());
}
