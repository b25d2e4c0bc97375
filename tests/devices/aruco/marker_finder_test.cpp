#include "devices/aruco/marker_finder.h"

#include <cstdio>
#include <numbers>

#include <doctest/doctest.h>

#include "tests/devices/aruco/rendered.h"

namespace focalstage {
namespace {

using sample::charuco_pattern;
using sample::marker_pattern;
using sample::photograph;
using sample::Sheet;
using sample::Shot;

constexpr int words = cv::aruco::DICT_4X4_50;
constexpr double size_m = 0.1;

CameraModel camera() { return {600.0, 605.0, 322.0, 238.5, {}}; }

glm::dquat turn(double degrees, const glm::dvec3& axis) {
  return glm::angleAxis(degrees * std::numbers::pi / 180.0, glm::normalize(axis));
}

double degrees_between(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat d = glm::conjugate(a) * b;
  return 2.0 * std::atan2(glm::length(glm::dvec3(d.x, d.y, d.z)), std::abs(d.w)) * 180.0 / std::numbers::pi;
}

ArucoSettings one_marker() {
  ArucoSettings settings;
  settings.camera = camera();
  settings.bodies = {{7, "Card", {{3, size_m, {}}}}};
  return settings;
}

MarkerFinder finder_of(const ArucoSettings& settings) {
  Result<MarkerFinder> finder = MarkerFinder::make(settings);
  REQUIRE(finder);
  return std::move(*finder);
}

/// Half a metre away and tilted, so that its pose is not in doubt.
const std::vector<Rigid> clear_poses{{{0.05, 0.02, -0.45}, turn(35, {1, 0.3, 0})},
                                     {{-0.1, -0.05, -0.5}, turn(40, {-0.2, 1, 0.5})},
                                     {{0.0, 0.08, -0.4}, turn(-45, {1, 1, 0.1})}};

TEST_CASE("a marker's pose: 1 mm across, 3 mm along, 1 degree, with noise and blur") {
  MarkerFinder finder = finder_of(one_marker());
  for (const Shot& shot : {Shot{}, Shot{640, 480, 3.0, 0.0, 5}, Shot{640, 480, 3.0, 1.0, 6}}) {
    for (const Rigid& pose : clear_poses) {
      const auto bodies = finder.find(photograph(camera(), {{pose, marker_pattern(words, 3, size_m)}}, shot));
      REQUIRE(bodies.size() == 1);
      const TrackedBody& body = bodies[0];
      CHECK(body.id == 7);
      CHECK(body.name == "Card");
      REQUIRE(body.tracked);
      const glm::dvec3 off = body.tracker_from_body.position_m - pose.position_m;
      std::printf("marker: %.2f mm across, %.2f mm along, %.2f degrees, error %.3f mm\n",
                  1e3 * std::hypot(off.x, off.y), 1e3 * std::abs(off.z),
                  degrees_between(body.tracker_from_body.rotation, pose.rotation), 1e3 * body.mean_error_m);
      CHECK(std::hypot(off.x, off.y) < 1e-3);
      CHECK(std::abs(off.z) < 3e-3);
      CHECK(degrees_between(body.tracker_from_body.rotation, pose.rotation) < 1.0);
      CHECK(body.mean_error_m > 0.0);
      CHECK(body.mean_error_m < 5e-4);
    }
  }
}

TEST_CASE("two poses that look alike are refused: far away and little tilted, with noise") {
  MarkerFinder finder = finder_of(one_marker());
  ArucoSettings trusting = one_marker();
  trusting.least_ratio = 0.0;
  MarkerFinder trusting_finder = finder_of(trusting);
  const Rigid pose{{0.0, 0.0, -2.2}, turn(10, {1, 0, 0})};
  int refused = 0;
  int wrong = 0;
  int wrong_if_trusted = 0;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const CameraFrame frame =
        photograph(camera(), {{pose, marker_pattern(words, 3, size_m)}}, Shot{640, 480, 6.0, 1.0, seed});
    const TrackedBody body = finder.find(frame)[0];
    const TrackedBody trusted = trusting_finder.find(frame)[0];
    REQUIRE(trusted.tracked);  // the marker is seen: what is refused is its pose
    const auto is_wrong = [&](const TrackedBody& seen) {
      return degrees_between(seen.tracker_from_body.rotation, pose.rotation) > 12.0;
    };
    refused += body.tracked ? 0 : 1;
    wrong += body.tracked && is_wrong(body) ? 1 : 0;
    wrong_if_trusted += is_wrong(trusted) ? 1 : 0;
    if (!body.tracked) CHECK(body.tracker_from_body == Rigid{});
  }
  std::printf("alike: %d of 20 refused, %d wrong; %d wrong were all trusted\n", refused, wrong, wrong_if_trusted);
  CHECK(refused >= 10);
  CHECK(wrong == 0);
  CHECK(wrong_if_trusted >= 1);
}

TEST_CASE("a body of several markers: any of them will do, all of them do better") {
  ArucoSettings settings;
  settings.camera = camera();
  // A corner of a box: two markers that face different ways.
  const Rigid front{{0.0, 0.0, 0.08}, {}};
  const Rigid side{{0.08, 0.0, 0.0}, turn(90, {0, 1, 0})};
  settings.bodies = {{1, "Box", {{10, size_m, front}, {11, size_m, side}}}, {2, "Away", {{12, size_m, {}}}}};
  MarkerFinder finder = finder_of(settings);
  const Rigid box{{0.02, 0.0, -0.5}, turn(-40, {0.2, 1, 0})};
  const Sheet front_sheet{box * front, marker_pattern(words, 10, size_m)};
  const Sheet side_sheet{box * side, marker_pattern(words, 11, size_m)};
  const Shot shot{640, 480, 2.0, 0.7, 3};
  for (const auto& sheets : {std::vector<Sheet>{front_sheet, side_sheet}, {front_sheet}, {side_sheet}}) {
    const auto bodies = finder.find(photograph(camera(), sheets, shot));
    REQUIRE(bodies.size() == 2);
    REQUIRE(bodies[0].tracked);
    CHECK_FALSE(bodies[1].tracked);
    const double off_m = glm::distance(bodies[0].tracker_from_body.position_m, box.position_m);
    const double off_deg = degrees_between(bodies[0].tracker_from_body.rotation, box.rotation);
    std::printf("box, %zu markers: %.2f mm, %.2f degrees\n", sheets.size(), 1e3 * off_m, off_deg);
    CHECK(off_m < (sheets.size() == 2 ? 1.5e-3 : 4e-3));
    CHECK(off_deg < (sheets.size() == 2 ? 0.4 : 1.5));
  }
}

TEST_CASE("a ChArUco board: its corners tell it to a third of a millimetre and a quarter of a degree") {
  ArucoSettings settings;
  settings.camera = camera();
  settings.boards = {{4, "Board", 5, 7, 0.03, 0.022}};
  MarkerFinder finder = finder_of(settings);
  const Rigid pose{{-0.06, -0.12, -0.5}, turn(25, {1, 0.5, 0})};
  for (const Shot& shot : {Shot{}, Shot{640, 480, 3.0, 0.8, 9}}) {
    const auto bodies = finder.find(photograph(camera(), {{pose, charuco_pattern(words, settings.boards[0])}}, shot));
    REQUIRE(bodies.size() == 1);
    REQUIRE(bodies[0].tracked);
    const double off_m = glm::distance(bodies[0].tracker_from_body.position_m, pose.position_m);
    const double off_deg = degrees_between(bodies[0].tracker_from_body.rotation, pose.rotation);
    std::printf("board: %.2f mm, %.2f degrees\n", 1e3 * off_m, off_deg);
    CHECK(off_m < 0.35e-3);  // half a pixel would be 0.6 mm
    CHECK(off_deg < 0.25);
  }
}

TEST_CASE("no marker, a marker twice, an empty picture: nothing is tracked") {
  MarkerFinder finder = finder_of(one_marker());
  const Rigid left{{-0.1, 0.0, -0.5}, turn(30, {1, 0, 0})};
  const Rigid right{{0.1, 0.0, -0.5}, turn(30, {1, 0, 0})};
  CHECK_FALSE(finder.find(photograph(camera(), {}))[0].tracked);
  CHECK_FALSE(finder.find(photograph(camera(), {{left, marker_pattern(words, 5, size_m)}}))[0].tracked);
  CHECK(finder.find(photograph(camera(), {{left, marker_pattern(words, 3, size_m)}}))[0].tracked);
  CHECK_FALSE(finder
                  .find(photograph(camera(), {{left, marker_pattern(words, 3, size_m)},
                                              {right, marker_pattern(words, 3, size_m)}}))[0]
                  .tracked);
  CHECK_FALSE(finder.find(CameraFrame{})[0].tracked);
}

TEST_CASE("settings that cannot be are refused by name") {
  const auto message_of = [](const ArucoSettings& settings) {
    const auto finder = MarkerFinder::make(settings);
    if (finder) return std::string();
    CHECK(finder.fault().code == "aruco.settings");
    return finder.fault().where + ": " + finder.fault().message;
  };
  CHECK(message_of(one_marker()).empty());
  ArucoSettings settings = one_marker();
  settings.dictionary = "7x7";
  CHECK(message_of(settings) == "dictionary: there is none named 7x7");
  settings = one_marker();
  settings.bodies[0].markers[0].marker = 50;
  CHECK(message_of(settings) == "body Card: the dictionary has no marker 50");
  settings = one_marker();
  settings.bodies.push_back({8, "Other", {{3, 0.1, {}}}});
  CHECK(message_of(settings).find("marker 3 is on another body") != std::string::npos);
  settings = one_marker();
  settings.bodies[0].markers[0].size_m = 0.0;
  CHECK(message_of(settings) == "body Card: a marker has no size");
  settings = one_marker();
  settings.bodies[0].markers.clear();
  CHECK(message_of(settings) == "body Card: it carries no marker");
  settings = one_marker();
  settings.camera.distortion = {0.1, 0.2, 0.3};
  CHECK(message_of(settings) == "camera: it has 3 distortion coefficients");
  settings = one_marker();
  settings.camera.fx_px = 0.0;
  CHECK(message_of(settings) == "camera: its focal length or centre cannot be");
  settings = {};
  settings.boards = {{4, "Board", 5, 6, 0.03, 0.022}};
  CHECK(message_of(settings).find("even number of rows") != std::string::npos);
  settings.boards = {{4, "Board", 5, 7, 0.03, 0.03}};
  CHECK(message_of(settings) == "board Board: its markers must be smaller than its squares");
  settings.boards = {{4, "Board", 2, 7, 0.03, 0.02}};
  CHECK(message_of(settings) == "board Board: it needs three squares each way");
}

}  // namespace
}  // namespace focalstage
