#include "io/rig_config/rig_config.h"

#include <fstream>

#include <doctest/doctest.h>

#include "tests/support/temporary_folder.h"

using namespace focalstage;

namespace {

// Everything said once, nothing as it is by default.
constexpr const char* whole = R"({
  "focalstage_rig": 1,
  "rig": {"name": "gallery", "kind": "devices"},
  "devices": {
    "projector": {"driver": "lightcrafter", "serial": "LC 1", "settings": {"zoom": 2, "after": "x", "invert": true}},
    "lens_drive": {"driver": "mcc1208", "address": "usb 1-2"},
    "trigger_board": {"driver": "uno"},
    "tracker": {"driver": "aruco", "settings": {"fx_px": 900},
                "camera": {"driver": "pictures", "folder": "seen", "settings": {"rate_hz": 25}}, "file": "walk.csv",
                "world_from_tracker": {"position_m": [1, 2, 3], "rotation_xyzw": [0, 0.6, 0, 0.8]},
                "bodies": [{"name": "wand", "id": 3, "body_from_thing": {"position_m": [0, 0, 0.1]},
                            "markers": [{"marker": 7, "size_m": 0.05, "body_from_marker": {"rotation_xyzw": [1, 0, 0, 0]}}]},
                           {"name": "table", "board": {"squares_x": 5, "squares_y": 7, "square_m": 0.04, "marker_m": 0.03}}]},
    "light_sensor": {"driver": "uno", "serial": "L1", "settings": {"left_input": 2},
                     "targets": [{"power_d": -1.2, "left_px": [10, 20, 4, 300], "right_px": [610, 20, 4, 300]},
                                 {"power_d": 0.9, "spread_d": 0.02, "left_px": [11, 20, 4, 300], "right_px": [611, 20, 4, 300]}]}
  },
  "measured": {
    "projector": {"model": "lightcrafter4500", "width_px": 912, "height_px": 1140, "frames_per_second": 4225, "bits": 1,
                  "color": "rgb", "latency_ms": 0.21, "pixel_layout": "diamond"},
    "glasses": {"lens_to_pupil_mm": 14, "lens_min_d": -3, "lens_max_d": 3.5, "lens_aperture_mm": 12,
                "shutter_close_ms": 0.3, "shutter_open_ms": 2.5,
                "lens_response": {"left": [{"frequency_hz": 0, "gain_d_per_a": 38},
                                           {"frequency_hz": 60, "gain_d_per_a": 37, "phase_deg": -15}],
                                  "right": [{"frequency_hz": 0, "gain_d_per_a": 36},
                                            {"frequency_hz": 120, "gain_d_per_a": 33, "phase_deg": -30}]}}
  },
  "limits": {"lens_current_max_a": 0.2, "shutter_changes_per_s_max": 150, "light_share_max": 0.5},
  "network": {"listen": "0.0.0.0:5000", "certificate": "pki/rig.pem", "key": "/etc/rig.key", "client_ca": "pki/ca.pem",
              "reflection": true, "push_bytes_per_s": 5e6, "calls_per_s": 20, "message_bytes_max": 3000000,
              "connections_max": 9, "connections_per_peer_max": 3, "streams_per_connection_max": 4},
  "clients": [{"name": "desk", "rights": ["watch"]},
              {"fingerprint": "0000000000000000000000000000000000000000000000000000000000000abc", "rights": ["push", "control"]}],
  "metrics": {"listen": "127.0.0.1:9464"},
  "osc": {"listen": "0.0.0.0:9000", "prefix": "/rig/one", "peers": ["10.0.0.7"], "despite_lease": true},
  "store": "shows",
  "log": {"level": "warning", "json": true}
})";

Fault refused(const std::string& text) {
  const auto config = parse_rig_config(text, "rig.json");
  REQUIRE_FALSE(config);
  return config.fault();
}

/// `whole` with the first `from` put as `to`.
std::string with(const std::string& from, const std::string& to) {
  std::string text = whole;
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("a file that says nothing is the default") {
  const auto config = parse_rig_config(R"({"focalstage_rig": 1})", "rig.json");
  REQUIRE(config);
  CHECK(*config == RigConfig{});
}

TEST_CASE("everything the file says arrives") {
  const auto read = parse_rig_config(whole, "rig.json", "/srv/rig");
  REQUIRE(read);
  const RigConfig& config = *read;
  CHECK(config.name == "gallery");
  CHECK(config.kind == RigKind::devices);
  REQUIRE(config.devices.projector);
  CHECK(config.devices.projector->driver == "lightcrafter");
  CHECK(config.devices.projector->serial == "LC 1");
  CHECK(config.devices.projector->settings == Value::Object{{"zoom", 2.0}, {"after", "x"}, {"invert", true}});
  CHECK(config.devices.lens_drive->address == "usb 1-2");
  CHECK(config.devices.trigger_board->settings.empty());
  REQUIRE(config.devices.tracker);
  const TrackerConfig& tracker = *config.devices.tracker;
  CHECK(tracker.device == DeviceConfig{"aruco", "", "", {{"fx_px", 900.0}}});
  CHECK(tracker.camera == DeviceConfig{"pictures", "", "", {{"rate_hz", 25.0}}});
  CHECK(tracker.camera_folder == "/srv/rig/seen");
  CHECK(tracker.file == "/srv/rig/walk.csv");
  CHECK(tracker.world_from_tracker == Rigid{{1, 2, 3}, {0.8, 0, 0.6, 0}});
  REQUIRE(tracker.bodies.size() == 2);
  CHECK(tracker.bodies[0] == BodyConfig{"wand", 3, {{7, 0.05, {{}, {0, 1, 0, 0}}}}, {}, {{0, 0, 0.1}, {1, 0, 0, 0}}});
  CHECK(tracker.bodies[1] == BodyConfig{"table", {}, {}, BodyBoardConfig{5, 7, 0.04, 0.03}, {}});
  REQUIRE(config.devices.light_sensor);
  CHECK(config.devices.light_sensor->device == DeviceConfig{"uno", "L1", "", {{"left_input", 2.0}}});
  CHECK(config.devices.light_sensor->targets ==
        std::vector<LightTargetConfig>{{-1.2, 0.01, {{10, 20, 4, 300}, {610, 20, 4, 300}}},
                                       {0.9, 0.02, {{11, 20, 4, 300}, {611, 20, 4, 300}}}});
  REQUIRE(config.measured);
  CHECK(config.measured->projector.model == "lightcrafter4500");
  CHECK(config.measured->projector.width_px == 912);
  CHECK(config.measured->projector.height_px == 1140);
  CHECK(config.measured->projector.frames_per_second == 4225.0);
  CHECK(config.measured->projector.bits == 1);
  CHECK(config.measured->projector.color == ColorMode::rgb);
  CHECK(config.measured->projector.latency_ms == 0.21);
  CHECK(config.measured->projector.pixel_layout == PixelLayout::diamond);
  CHECK(config.measured->glasses.lens_to_pupil_mm == 14.0);
  CHECK(config.measured->glasses.lens_range_d == std::array<double, 2>{-3.0, 3.5});
  CHECK(config.measured->glasses.lens_aperture_mm == 12.0);
  CHECK(config.measured->glasses.shutter_close_ms == 0.3);
  CHECK(config.measured->glasses.shutter_open_ms == 2.5);
  CHECK(config.measured->response.left == std::vector<ResponsePoint>{{0, 38, 0}, {60, 37, -15}});
  CHECK(config.measured->response.right == std::vector<ResponsePoint>{{0, 36, 0}, {120, 33, -30}});
  CHECK(config.limits == LimitsConfig{0.2, 150.0, 0.5});
  CHECK(config.listen == "0.0.0.0:5000");
  CHECK(config.network == NetworkConfig{"/srv/rig/pki/rig.pem", "/etc/rig.key", "/srv/rig/pki/ca.pem", true, 5e6, 20.0,
                                        3000000, 9, 3, 4});
  REQUIRE(config.clients.size() == 2);
  CHECK(config.clients[0] == ClientConfig{"desk", "", {true, false, false}});
  CHECK(config.clients[1] == ClientConfig{"", std::string(61, '0') + "abc", {false, true, true}});
  CHECK(config.metrics_listen == "127.0.0.1:9464");
  CHECK(config.osc == OscConfig{"0.0.0.0:9000", "/rig/one", {"10.0.0.7"}, true});
  CHECK(config.store == "/srv/rig/shows");
  CHECK(config.log_level == LogLevel::warning);
  CHECK(config.log_json);
}

TEST_CASE("a key that nobody knows is refused wherever it stands, and its place is named") {
  const Fault top = refused(R"({"focalstage_rig": 1, "lens_curent": 0.1})");
  CHECK(top.code == "rig.schema");
  CHECK(top.where.find("rig.json") == 0);
  CHECK(top.message.find("lens_curent") != std::string::npos);
  CHECK(top.remedy.find("io/schema/rig.schema.json") != std::string::npos);
  const Fault limits = refused(R"({"focalstage_rig": 1, "limits": {"lens_current_max": 0.1}})");
  CHECK(limits.where == "rig.json: /limits");
  CHECK(refused(with(R"("latency_ms")", R"("latency_s")")).where.find("/measured/projector") != std::string::npos);
  CHECK(refused(with(R"("address": "usb 1-2")", R"("adress": "usb 1-2")")).where == "rig.json: /devices/lens_drive");
  CHECK(refused(with(R"("peers")", R"("peer")")).where == "rig.json: /osc");
}

TEST_CASE("values that cannot be are refused at their place") {
  const auto place = [](const std::string& from, const std::string& to) { return refused(with(from, to)).where; };
  CHECK(place(R"("lens_current_max_a": 0.2)", R"("lens_current_max_a": 0.3)") ==
        "rig.json: /limits/lens_current_max_a");
  CHECK(place(R"("light_share_max": 0.5)", R"("light_share_max": 0)") == "rig.json: /limits/light_share_max");
  CHECK(place(R"("width_px": 912)", R"("width_px": 912.5)") == "rig.json: /measured/projector/width_px");
  CHECK(place(R"("message_bytes_max": 3000000)", R"("message_bytes_max": 1000)") ==
        "rig.json: /network/message_bytes_max");
  CHECK(place(R"("rights": ["watch"])", R"("rights": ["all"])") == "rig.json: /clients/0/rights/0");
  CHECK(place(R"("zoom": 2)", R"("zoom": [2])") == "rig.json: /devices/projector/settings/zoom");
  CHECK(place(R"("kind": "devices")", R"("kind": "real")") == "rig.json: /rig/kind");
}

TEST_CASE("what a schema cannot say is refused too") {
  const auto refusal = [](const std::string& from, const std::string& to, const std::string& where) {
    const Fault fault = refused(with(from, to));
    CHECK(fault.code == "rig.config");
    CHECK(fault.where == "rig.json: " + where);
    CHECK_FALSE(fault.remedy.empty());
  };
  refusal(R"("trigger_board": {"driver": "uno"},)", "", "/devices/trigger_board");
  refusal(R"("frequency_hz": 60)", R"("frequency_hz": 0)", "/measured/glasses/lens_response/left/1/frequency_hz");
  refusal(R"("frequency_hz": 0, "gain_d_per_a": 36)", R"("frequency_hz": 1, "gain_d_per_a": 36)",
          "/measured/glasses/lens_response/right/0/frequency_hz");
  refusal(R"("lens_max_d": 3.5)", R"("lens_max_d": -3)", "/measured/glasses/lens_max_d");
  refusal(R"("rotation_xyzw": [0, 0.6, 0, 0.8])", R"("rotation_xyzw": [0, 0, 0, 0])",
          "/devices/tracker/world_from_tracker/rotation_xyzw");
  refusal(R"("rotation_xyzw": [1, 0, 0, 0])", R"("rotation_xyzw": [1, 1, 0, 0])",
          "/devices/tracker/bodies/0/markers/0/body_from_marker/rotation_xyzw");
  refusal(R"("name": "table")", R"("name": "wand")", "/devices/tracker/bodies/1/name");
  refusal(R"("power_d": 0.9)", R"("power_d": -1.1)", "/devices/light_sensor/targets/1/power_d");
  refusal(R"([611, 20, 4, 300])", R"([611, 20, 0, 300])", "/devices/light_sensor/targets/1/right_px");
  refusal(R"("key": "/etc/rig.key",)", "", "/network");
  refusal(R"("name": "desk", )", "", "/clients/0");
  CHECK(refused(R"({"focalstage_rig": 1, "rig": {"kind": "devices"}})").where == "rig.json: /devices/projector");
}

TEST_CASE("a file's paths are relative to its folder, and one that is not there is named") {
  const TemporaryFolder folder;
  std::ofstream(folder / "rig.json") << R"({"focalstage_rig": 1, "store": "here"})";
  const auto config = load_rig_config(folder / "rig.json");
  REQUIRE(config);
  CHECK(config->store == folder / "here");
  const auto none = load_rig_config(folder / "none.json");
  REQUIRE_FALSE(none);
  CHECK(none.fault().where.find("none.json") != std::string::npos);
  CHECK(parse_rig_config("{", "rig.json").fault().code == "json.syntax");
}
