#include "devices/runtime/tracker_setup.h"

#include <doctest/doctest.h>

#include "devices/runtime/configured_rig.h"

namespace focalstage {
namespace {

TEST_CASE("trackers by the words of a command line, and names of none") {
  const auto multicast = tracker_named("natnet:192.168.1.5");
  REQUIRE(multicast);
  CHECK(multicast->device.driver == "natnet");
  CHECK(multicast->device.address == "192.168.1.5");
  CHECK(multicast->device.settings.empty());
  const auto unicast = tracker_named("natnet-unicast:10.0.0.1");
  REQUIRE(unicast);
  CHECK(unicast->device.settings == Value::Object{{"cast", "unicast"}});
  CHECK(tracker_setup(*unicast).ok());
  const auto recording = tracker_named("recording:/nowhere");
  REQUIRE(recording);
  CHECK(recording->file == "/nowhere");
  CHECK(tracker_setup(*recording).fault().code == "recording.unreadable");
  for (const char* text : {"", "natnet", "natnet:", "recording:", "vicon:host"}) {
    CHECK(tracker_named(text).fault().code == "tracker.unknown");
  }
}

TEST_CASE("a file's tracker reaches the runtime with its place and what is fixed to its bodies, on any rig") {
  const auto config = parse_rig_config(R"({"focalstage_rig": 1, "devices": {"tracker": {
    "driver": "natnet", "address": "127.0.0.1", "settings": {"cast": "unicast", "axes": "z_up"},
    "world_from_tracker": {"position_m": [1, 2, 3], "rotation_xyzw": [0, 0.63, 0, 0.84]},
    "bodies": [{"name": "wand", "id": 4, "body_from_thing": {"position_m": [0, 0, 0.1]}}, {"name": "head"}]}}})",
                                       "rig.json");
  REQUIRE(config);
  const auto options = runtime_options(*config);
  REQUIRE(options);
  const TrackerSetup& setup = options->tracker;
  REQUIRE(setup.tracker);
  CHECK(setup.tracker->state().phase == TrackerPhase::off);
  CHECK(setup.id == DeviceId{"natnet", "tracker", "", "127.0.0.1"});
  CHECK(setup.world_from_tracker.position_m == glm::dvec3(1, 2, 3));
  CHECK(setup.world_from_tracker.rotation.w == doctest::Approx(0.8));
  CHECK(setup.world_from_tracker.rotation.y == doctest::Approx(0.6));
  REQUIRE(setup.body_from_thing.size() == 2);
  CHECK(setup.body_from_thing.at("wand").position_m == glm::dvec3(0, 0, 0.1));
  CHECK(setup.body_from_thing.at("head") == Rigid{});
}

TEST_CASE("a tracker that cannot be is refused with its place in the file") {
  const auto config = parse_rig_config(
      R"({"focalstage_rig": 1, "devices": {"tracker": {"driver": "natnet", "settings": {"casts": "unicast"}}}})",
      "rig.json");
  REQUIRE(config);
  const auto options = runtime_options(*config);
  REQUIRE_FALSE(options);
  CHECK(options.fault().where == "/devices/tracker/settings/casts");
}

}  // namespace
}  // namespace focalstage
