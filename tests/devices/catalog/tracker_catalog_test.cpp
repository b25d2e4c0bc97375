#include "devices/catalog/tracker_catalog.h"

#include <chrono>
#include <fstream>
#include <thread>

#include <doctest/doctest.h>

#include "devices/camera/pgm.h"
#include "tests/support/temporary_folder.h"

namespace focalstage {
namespace {

TrackerConfig natnet() {
  TrackerConfig config;
  config.device = {"natnet", "", "127.0.0.1", {}};
  return config;
}

BodyConfig carrier(int marker = 3) {
  BodyConfig body;
  body.name = "wand";
  body.markers = {{marker, 0.05, {}}};
  return body;
}

TrackerConfig aruco() {
  TrackerConfig config;
  config.device = {"aruco", "", "", {{"fx_px", 900}, {"fy_px", 900}, {"cx_px", 32}, {"cy_px", 24}, {"k1", -0.1}}};
  config.camera = DeviceConfig{"v4l2", "", "/dev/video9", {{"width_px", 640}, {"exposure_s", 0.004}}};
  config.bodies = {carrier()};
  return config;
}

std::string place_of(const TrackerConfig& config) {
  const auto made = make_tracker(config);
  return made ? "" : made.fault().where;
}

TEST_CASE("trackers are made of what the file says, and nothing is opened yet") {
  TrackerConfig config = natnet();
  config.device.settings = {{"cast", "unicast"}, {"data_port", 0}, {"axes", "z_up"}, {"description_size", "none"}};
  config.bodies = {{"wand", 7, {}, {}, {}}};
  for (const TrackerConfig& each : {config, aruco()}) {
    const auto made = make_tracker(each);
    REQUIRE(made);
    CHECK((*made)->state().phase == TrackerPhase::off);
  }
}

TEST_CASE("what cannot be is named by its place in the file") {
  TrackerConfig config = natnet();
  config.device.driver = "vicon";
  CHECK(place_of(config) == "/devices/tracker/driver");
  config = natnet();
  config.device.address.clear();
  CHECK(place_of(config) == "/devices/tracker/address");
  config = natnet();
  config.device.settings = {{"cast", "broadcast"}};
  CHECK(place_of(config) == "/devices/tracker/settings/cast");
  CHECK(make_tracker(config).fault().message.find("multicast or unicast") != std::string::npos);
  config.device.settings = {{"cast", ""}};
  CHECK(place_of(config) == "/devices/tracker/settings/cast");
  config.device.settings = {{"silence_s", 1.0}};  // rig.tracker is to come within 100 ms
  CHECK(place_of(config) == "/devices/tracker/settings/silence_s");
  config = natnet();
  config.bodies = {carrier()};
  CHECK(place_of(config) == "/devices/tracker/bodies/0/markers");
  config = natnet();
  config.file = "walk.csv";
  CHECK(place_of(config) == "/devices/tracker/file");
  config = natnet();
  config.device.driver = "recording";
  CHECK(place_of(config) == "/devices/tracker/file");

  config = aruco();
  config.camera.reset();
  CHECK(place_of(config) == "/devices/tracker/camera");
  config = aruco();
  config.camera->settings = {{"gain", 3}};
  CHECK(place_of(config) == "/devices/tracker/camera/settings/gain");
  CHECK(make_tracker(config).fault().remedy.find("devices/camera") != std::string::npos);
  config = aruco();
  config.camera->driver = "pictures";
  config.camera->settings.clear();
  CHECK(place_of(config) == "/devices/tracker/camera/folder");
  config = aruco();
  config.bodies[0].id = 4;
  CHECK(place_of(config) == "/devices/tracker/bodies/0/id");
  config = aruco();
  config.bodies[0].board = BodyBoardConfig{5, 7, 0.04, 0.03};
  CHECK(place_of(config) == "/devices/tracker/bodies/0");
  config.bodies.clear();
  CHECK(place_of(config) == "/devices/tracker/bodies");
}

TEST_CASE("markers are looked for in the pictures of the folder that the file names") {
  const TemporaryFolder folder;
  REQUIRE(write_pgm((folder / "1.pgm").string(), {64, 48, std::vector<std::uint8_t>(64 * 48, 128)}));
  TrackerConfig config = aruco();
  config.camera = DeviceConfig{"pictures", "", "", {{"rate_hz", 100}}};
  config.camera_folder = folder.path();
  const auto made = make_tracker(config);
  REQUIRE(made);
  REQUIRE((*made)->start());
  for (int wait = 0; wait < 500 && !(*made)->newest(); ++wait) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const auto frame = (*made)->newest();
  REQUIRE(frame);
  REQUIRE(frame->bodies.size() == 1);
  CHECK(frame->bodies[0].name == "wand");
  CHECK_FALSE(frame->bodies[0].tracked);
  (*made)->stop();
}

TEST_CASE("a marker that its dictionary has not got is refused once it is to start") {
  TrackerConfig config = aruco();
  config.bodies = {carrier(5000)};
  const auto made = make_tracker(config);
  REQUIRE(made);
  CHECK((*made)->start().fault().code == "aruco.settings");
}

}  // namespace
}  // namespace focalstage
