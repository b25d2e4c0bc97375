#include "core/calibrate/picked_points.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/core/calibrate/own_optics.h"

using namespace focalstage;
using doctest::Approx;

namespace {

/// A projector up on the left that looks down into the room, its lens bent and off its middle.
own::Lens truth() {
  own::Lens lens;
  lens.fx = 1384.0;
  lens.fy = 1391.0;
  lens.cx = 520.0;
  lens.cy = 371.0;
  lens.k1 = -0.08;
  lens.k2 = 0.03;
  lens.p1 = 0.001;
  lens.p2 = -0.0007;
  lens.world_from_own = own::turned(-12.0, -9.0, 4.0);
  lens.at = {-0.4, 0.35, 1.1};
  return lens;
}

/// What is known of it; with a pose that is nobody's.
ProjectorModel known_of(const own::Lens& lens) {
  ProjectorModel model;
  model.width_px = lens.width;
  model.height_px = lens.height;
  model.focal_px = {lens.fx, lens.fy};
  model.centre_px = {lens.cx, lens.cy};
  model.distortion = {lens.k1, lens.k2, lens.p1, lens.p2, lens.k3};
  model.world_from_projector = {{9.0, 9.0, 9.0}, {1.0, 0.0, 0.0, 0.0}};
  return model;
}

/// Where the ray of a pixel is so deep in the room.
own::Vector place(const own::Lens& lens, double u, double v, double depth_m) {
  return own::plus(lens.at, own::scaled(lens.look(u, v), depth_m));
}

const std::vector<own::Vector> places{place(truth(), 90, 110, 2.0),  place(truth(), 930, 80, 1.6),
                                      place(truth(), 850, 690, 1.3), place(truth(), 130, 650, 1.9),
                                      place(truth(), 500, 400, 2.2), place(truth(), 320, 240, 1.4),
                                      place(truth(), 700, 300, 1.8), place(truth(), 400, 600, 1.5),
                                      place(truth(), 620, 150, 2.1), place(truth(), 240, 420, 1.7)};

/// The points as `lens` lights them, picked with an error of so many pixels along each axis.
std::vector<PickedPoint> picked(const own::Lens& lens, const std::vector<own::Vector>& at, double noise_px = 0.0,
                                std::uint32_t seed = 1) {
  std::mt19937 dice(seed);
  std::normal_distribution<double> error(0.0, 1.0);
  std::vector<PickedPoint> points;
  for (const own::Vector& p : at) {
    const auto pixel = lens.pixel(p);
    REQUIRE(pixel);
    REQUIRE(pixel->x > 0.0);
    REQUIRE(pixel->x < lens.width);
    REQUIRE(pixel->y > 0.0);
    REQUIRE(pixel->y < lens.height);
    const double dx = noise_px * error(dice);
    const double dy = noise_px * error(dice);
    points.push_back({"", {p[0], p[1], p[2]}, *pixel + glm::dvec2(dx, dy)});
  }
  return points;
}

std::vector<own::Vector> first(std::size_t count) {
  return {places.begin(), places.begin() + static_cast<long>(count)};
}

std::vector<own::Vector> flat() {
  std::vector<own::Vector> at = places;
  for (own::Vector& p : at) p[2] = -0.6 + 0.3 * p[0] - 0.2 * p[1];
  return at;
}

double off_mm(const ProjectorModel& model, const own::Lens& lens) {
  const glm::dvec3& p = model.world_from_projector.position_m;
  return 1e3 * own::length(own::minus({p.x, p.y, p.z}, lens.at));
}

double off_deg(const ProjectorModel& model, const own::Lens& lens) {
  return own::angle_deg(own::matrix_of(model.world_from_projector.rotation), lens.world_from_own);
}

Fault fault_of(const std::vector<PickedPoint>& points, LensFreedom freedom = LensFreedom::fixed) {
  const auto result = calibrate_by_points(known_of(truth()), points, freedom);
  return result ? Fault{} : result.fault();
}

}  // namespace

TEST_CASE("exact points give the pose exactly, from six on") {
  for (const std::size_t count : {6u, 7u, 10u}) {
    const auto found = calibrate_by_points(known_of(truth()), picked(truth(), first(count)), LensFreedom::fixed);
    REQUIRE(found);
    CHECK(off_mm(found->model, truth()) < 1e-5);
    CHECK(off_deg(found->model, truth()) < 1e-6);
    CHECK(found->report.worst_px < 1e-6);
    CHECK(*found->report.left_out_median_px < 1e-5);
    CHECK(found->report.uncertainty.position_mm < 1e-3);
    CHECK(check_limit(found->report).ok());
    CHECK(found->model.focal_px == known_of(truth()).focal_px);  // not asked for
  }
}

TEST_CASE("points in one plane give the pose too") {
  const auto found = calibrate_by_points(known_of(truth()), picked(truth(), flat(), 0.3), LensFreedom::fixed);
  REQUIRE(found);
  CHECK(off_mm(found->model, truth()) < 10.0);
  CHECK(off_deg(found->model, truth()) < 0.5);
}

TEST_CASE("focal length and centre come out where they are asked for, from far off") {
  ProjectorModel known = known_of(truth());
  known.focal_px = glm::dvec2(1384.0, 1391.0) * 0.6;
  auto found = calibrate_by_points(known, picked(truth(), places), LensFreedom::focal);
  REQUIRE(found);
  CHECK(found->model.focal_px.x == Approx(1384.0).epsilon(1e-6));
  CHECK(found->model.focal_px.y == Approx(1391.0).epsilon(1e-6));
  CHECK(off_mm(found->model, truth()) < 1e-3);
  known.centre_px = {512.0, 384.0};
  known.focal_px *= 2.5;
  found = calibrate_by_points(known, picked(truth(), places), LensFreedom::centre);
  REQUIRE(found);
  CHECK(found->model.focal_px.x == Approx(1384.0).epsilon(1e-6));
  CHECK(found->model.centre_px.x == Approx(520.0).epsilon(1e-5));
  CHECK(found->model.centre_px.y == Approx(371.0).epsilon(1e-5));
  CHECK(off_mm(found->model, truth()) < 1e-3);
}

// Of n points with independent errors of s along each axis, the expected sum of squared residuals is s^2 (2 n - 6).
TEST_CASE("residuals and uncertainty are as large as the noise makes them") {
  const double noise_px = 0.5;
  double square_sum = 0.0;
  double position_square_mm2 = 0.0;
  double said_square_mm2 = 0.0;
  double left_out = 0.0;
  double median = 0.0;
  int done = 0;
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    const auto found =
        calibrate_by_points(known_of(truth()), picked(truth(), places, noise_px, seed), LensFreedom::fixed);
    if (!found) continue;
    ++done;
    for (const PointResidual& residual : found->report.residuals) square_sum += std::pow(residual.distance_px, 2);
    position_square_mm2 += std::pow(off_mm(found->model, truth()), 2);
    said_square_mm2 += std::pow(found->report.uncertainty.position_mm, 2);
    left_out += *found->report.left_out_median_px;
    median += found->report.median_px;
  }
  CHECK(done >= 29);
  const double n = static_cast<double>(places.size());
  CHECK(square_sum / done == Approx(noise_px * noise_px * (2.0 * n - 6.0)).epsilon(0.25));
  CHECK(position_square_mm2 == Approx(said_square_mm2).epsilon(0.5));
  CHECK(left_out > 1.2 * median);
}

TEST_CASE("the point that lies is named, wherever it stands, and of seven two") {
  for (std::size_t liar = 0; liar < 6; ++liar) {
    auto points = picked(truth(), first(6), 0.2, 3);
    points[liar].name = "liar";
    points[liar].pixel += glm::dvec2(23.0, -31.0);
    const Fault fault = fault_of(points);
    CHECK(fault.code == "points.lying");
    CHECK(fault.where == "point " + std::to_string(liar + 1) + " (liar)");
  }
  auto points = picked(truth(), places, 0.3, 4);
  points[1].world_m.y += 0.05;
  points[7].pixel.x -= 60.0;
  points[8].pixel.y += 200.0;
  const Fault fault = fault_of(points);
  CHECK(fault.code == "points.lying");
  CHECK(fault.where == "points 2, 8, 9");
  CHECK(fault_of(picked(truth(), places, 0.3, 4)).code.empty());
}

TEST_CASE("a small lie among good points is seen too") {
  auto points = picked(truth(), places, 0.1, 5);
  points[4].pixel.x += 2.0;
  CHECK(fault_of(points).where == "point 5");
}

TEST_CASE("a liar is named where the lens is asked for too") {
  auto points = picked(truth(), places, 0.2, 6);
  points[2].pixel += glm::dvec2(40.0, 15.0);
  const Fault fault = fault_of(points, LensFreedom::focal);
  CHECK(fault.code == "points.lying");
  CHECK(fault.where == "point 3");
}

TEST_CASE("good points are not called liars: one in a thousand sets") {
  int refused = 0;
  for (std::uint32_t seed = 0; seed < 15; ++seed) {
    refused += fault_of(picked(truth(), first(7), 0.4, seed)).code.empty() ? 0 : 1;
    refused += fault_of(picked(truth(), flat(), 0.4, seed)).code.empty() ? 0 : 1;
  }
  CHECK(refused <= 1);
}

TEST_CASE("two that have each other's pixel are told to be exchanged") {
  auto points = picked(truth(), places, 0.2, 7);
  std::swap(points[3].pixel, points[8].pixel);
  const Fault fault = fault_of(points);
  CHECK(fault.code == "points.exchanged");
  CHECK(fault.where == "points 4, 9");
}

TEST_CASE("all pixels beside the wrong places: nothing agrees, and that is said") {
  auto points = picked(truth(), places);
  const glm::dvec2 first_pixel = points[0].pixel;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) points[i].pixel = points[i + 1].pixel;
  points.back().pixel = first_pixel;
  CHECK(fault_of(points).code == "points.mismatched");
}

TEST_CASE("a mirrored axis is told from bad picking") {
  auto points = picked(truth(), places, 0.3, 8);
  for (PickedPoint& p : points) p.world_m.x *= -1.0;
  CHECK(fault_of(points).code == "points.mirrored");
  points = picked(truth(), places, 0.3, 8);
  for (PickedPoint& p : points) p.pixel.y = 768.0 - p.pixel.y;
  CHECK(fault_of(points).code == "points.mirrored");
}

TEST_CASE("a point behind the projector is named") {
  auto points = picked(truth(), places, 0.2, 9);
  // On the same ray, but backwards: its formula would give the same pixel.
  const glm::dvec3 at(truth().at[0], truth().at[1], truth().at[2]);
  points[6].world_m = at - 0.5 * (points[6].world_m - at);
  const Fault fault = fault_of(points);
  CHECK(fault.code == "points.behind");
  CHECK(fault.where == "point 7");
}

TEST_CASE("too few, no numbers, outside, twice, on one line, in one plane: refused by name") {
  CHECK(fault_of({}).code == "points.few");
  CHECK(fault_of(picked(truth(), first(5))).code == "points.few");
  CHECK(fault_of(picked(truth(), first(6)), LensFreedom::focal).code == "points.few");
  CHECK(fault_of(picked(truth(), first(7)), LensFreedom::centre).code == "points.few");
  auto points = picked(truth(), places);
  points[3].name = "lamp";
  points[3].world_m.z = std::numeric_limits<double>::quiet_NaN();
  CHECK(fault_of(points).code == "points.finite");
  CHECK(fault_of(points).where == "point 4 (lamp)");
  points = picked(truth(), places);
  points[2].pixel.y = std::numeric_limits<double>::infinity();
  CHECK(fault_of(points).code == "points.finite");
  points[2].pixel.y = 768.5;
  CHECK(fault_of(points).code == "points.outside");
  CHECK(fault_of(points).where == "point 3");
  points = picked(truth(), places);
  points[5].world_m = points[1].world_m;
  CHECK(fault_of(points).code == "points.twice");
  CHECK(fault_of(points).where == "point 6");
  std::vector<own::Vector> line;
  const own::Vector along = own::minus(places[2], places[0]);
  for (int i = 0; i < 7; ++i) line.push_back(own::plus(places[0], own::scaled(along, i / 6.0)));
  CHECK(fault_of(picked(truth(), line)).code == "points.collinear");
  CHECK(fault_of(picked(truth(), flat()), LensFreedom::focal).code == "points.coplanar");
}

TEST_CASE("points in a plane through the projector are one line in its picture") {
  std::vector<own::Vector> at;
  for (int i = 0; i < 8; ++i) {
    // The projector's own x = 0, where its lens bends least.
    const own::Vector own_place{0.0, -0.2 + 0.06 * i, -1.0 - 0.2 * (i % 3)};
    at.push_back(own::plus(own::times(truth().world_from_own, own_place), truth().at));
  }
  CHECK(fault_of(picked(truth(), at)).code == "points.collinear");
}

TEST_CASE("a small far plane that could lean either way is refused") {
  std::vector<own::Vector> at;
  const own::Matrix lean = own::times(truth().world_from_own, own::turned(20.0, 0.0, 0.0));
  for (int i = 0; i < 9; ++i) {
    const own::Vector on_plane{0.05 * (i % 3 - 1), 0.05 * (i / 3 - 1), 0.0};
    const own::Vector middle = own::plus(truth().at, own::times(truth().world_from_own, own::Vector{0.0, 0.0, -3.0}));
    at.push_back(own::plus(middle, own::times(lean, on_plane)));
  }
  CHECK(fault_of(picked(truth(), at, 0.5, 2)).code == "points.ambiguous");
}

TEST_CASE("a focal length that points hardly tell is refused") {
  std::vector<own::Vector> at;
  for (int i = 0; i < 9; ++i) {
    const own::Vector near_middle{0.1 * (i % 3 - 1), 0.1 * (i / 3 - 1), -2.0 + 0.01 * ((i * 5) % 4)};
    at.push_back(own::plus(truth().at, own::times(truth().world_from_own, near_middle)));
  }
  CHECK(fault_of(picked(truth(), at, 0.5, 2), LensFreedom::focal).code == "points.weak");
}

TEST_CASE("many noisy points are over the limit, and the worst is named") {
  const auto found = calibrate_by_points(known_of(truth()), picked(truth(), places, 4.0, 11), LensFreedom::fixed);
  REQUIRE(found);
  const Status refused = check_limit(found->report);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.fault().code == "calibrate.limit");
  CHECK(refused.fault().where == "point " + std::to_string(found->report.worst + 1));
  CHECK(check_limit(found->report, 20.0).ok());
}

TEST_CASE("the same points give the same bytes") {
  const auto points = picked(truth(), places, 0.5, 12);
  const auto once = calibrate_by_points(known_of(truth()), points, LensFreedom::centre);
  const auto again = calibrate_by_points(known_of(truth()), points, LensFreedom::centre);
  REQUIRE(once);
  REQUIRE(again);
  CHECK(once->model == again->model);
}
