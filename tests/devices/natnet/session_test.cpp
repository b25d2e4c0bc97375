#include "devices/natnet/session.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "devices/natnet/bodies.h"
#include "tests/devices/natnet/emulator/server_bytes.h"

namespace focalstage {
namespace {

using natnet_emulator::Dialect;
using natnet_emulator::Moment;

constexpr std::uint64_t ticks_per_s = 10000000;

/// Seen at `time_s`, sent 4 ms later.
Moment moment_at(int number, double time_s) {
  Moment moment;
  moment.number = number;
  moment.bodies = {{7, "", {0.25F, 1.5F, -0.75F}}};
  moment.timestamp = time_s;
  moment.exposed = static_cast<std::uint64_t>(std::llround((100.0 + time_s) * 1e7));
  moment.sent = moment.exposed + 40000;
  return moment;
}

NatNetSettings settings_of(NatNetAxes axes = NatNetAxes::y_up) {
  NatNetSettings settings;
  settings.axes = axes;
  return settings;
}

NatNetSession greeted(const NatNetSettings& settings = {}, const Dialect& dialect = {}) {
  NatNetSession session(settings, 0.0);
  session.take(natnet_emulator::server_info(dialect, ticks_per_s, 1511, true), 0.0);
  return session;
}

bool holds(const std::vector<NatNetBytes>& messages, const NatNetBytes& message) {
  return std::find(messages.begin(), messages.end(), message) != messages.end();
}

TrackedBody body_of(const Moment& moment, NatNetAxes axes = NatNetAxes::y_up) {
  NatNetSession session = greeted(settings_of(axes));
  session.take(natnet_emulator::frame({}, moment), 1.0);
  REQUIRE(session.newest());
  return session.newest()->bodies.at(0);
}

TEST_CASE("the talk: ping until answered, then names and keep-alives, pings again once lost") {
  NatNetSession session({}, 0.0);
  CHECK(session.due(0.0) == std::vector<NatNetBytes>{ping_message()});
  CHECK(session.due(0.1).empty());
  CHECK(session.due(0.3) == std::vector<NatNetBytes>{ping_message()});
  session.take(natnet_emulator::server_info({}, ticks_per_s, 1511, true), 0.31);
  CHECK(session.due(0.32) == std::vector<NatNetBytes>{model_request_message(), keep_alive_message()});
  session.take(natnet_emulator::descriptions({}, {{7, "Head"}}), 0.33);
  int keep_alives = 0;
  for (int i = 0; i < 320; ++i) {
    const double now_s = 0.34 + 0.01 * i;
    session.take(natnet_emulator::frame({}, moment_at(i, now_s)), now_s);
    const auto messages = session.due(now_s);
    CHECK_FALSE(holds(messages, ping_message()));
    CHECK_FALSE(holds(messages, model_request_message()));
    keep_alives += holds(messages, keep_alive_message()) ? 1 : 0;
  }
  CHECK(keep_alives == 3);  // one a second
  CHECK(session.newest()->bodies.at(0).name == "Head");
  CHECK(holds(session.due(5.0), ping_message()));
}

TEST_CASE("names are asked for again when a frame says that they changed; names of the settings come first") {
  NatNetSettings settings;
  settings.names[7] = "Viewer";
  NatNetSession session = greeted(settings);
  session.due(0.0);
  session.take(natnet_emulator::descriptions({}, {{7, "Head"}, {8, "Box"}}), 0.01);
  CHECK_FALSE(holds(session.due(1.0), model_request_message()));
  Moment moment = moment_at(1, 1.0);
  moment.bodies.push_back({8, ""});
  moment.bodies.push_back({9, ""});
  moment.param = 2;
  session.take(natnet_emulator::frame({}, moment), 1.0);
  CHECK(session.newest()->bodies.at(0).name == "Viewer");
  CHECK(session.newest()->bodies.at(1).name == "Box");
  CHECK(session.newest()->bodies.at(2).name.empty());
  CHECK(holds(session.due(1.01), model_request_message()));
}

TEST_CASE("a frame's time, latency and pose") {
  NatNetSession session = greeted();
  session.take(natnet_emulator::frame({}, moment_at(5, 2.5)), 7.0);
  const auto frame = session.newest();
  REQUIRE(frame);
  CHECK(frame->number == 5);
  CHECK(frame->time_s == 2.5);
  CHECK(frame->arrival_s == 7.0);
  REQUIRE(frame->latency_s.has_value());
  CHECK(*frame->latency_s == doctest::Approx(0.004));
  CHECK(frame->bodies.at(0).tracked);
  CHECK(frame->bodies.at(0).tracker_from_body == Rigid{{0.25, 1.5, -0.75}, {1.0, 0.0, 0.0, 0.0}});
}

TEST_CASE("latency that a server does not tell, or that no camera has, is none") {
  Moment untold = moment_at(1, 0.0);
  untold.exposed = 0;
  Moment backwards = moment_at(1, 0.0);
  backwards.exposed = backwards.sent + 1;
  Moment hours = moment_at(1, 0.0);
  hours.exposed = 1;
  for (const Moment& moment : {untold, backwards, hours}) {
    NatNetSession session = greeted();
    session.take(natnet_emulator::frame({}, moment), 1.0);
    REQUIRE(session.newest());
    CHECK_FALSE(session.newest()->latency_s.has_value());
  }
}

TEST_CASE("what cannot be a pose is a body that is not tracked") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Moment lost = moment_at(1, 0.0);
  lost.bodies[0].param = 0;
  Moment no_number = moment_at(1, 0.0);
  no_number.bodies[0].position[1] = nan;
  Moment no_turn = moment_at(1, 0.0);
  no_turn.bodies[0].xyzw = {0.0F, 0.0F, 0.0F, 0.0F};
  Moment infinite = moment_at(1, 0.0);
  infinite.bodies[0].xyzw[3] = std::numeric_limits<float>::infinity();
  for (const Moment& moment : {lost, no_number, no_turn, infinite}) {
    const TrackedBody body = body_of(moment);
    CHECK(body.id == 7);
    CHECK_FALSE(body.tracked);
    CHECK(body.tracker_from_body == Rigid{});
  }
}

TEST_CASE("a Z-up stream is turned to Y up") {
  // One metre east, two north, three high; turned a quarter about the vertical: its east looks north.
  Moment moment = moment_at(1, 0.0);
  moment.bodies[0].position = {1.0F, 2.0F, 3.0F};
  const float half = std::sqrt(0.5F);
  moment.bodies[0].xyzw = {0.0F, 0.0F, half, half};
  const TrackedBody body = body_of(moment, NatNetAxes::z_up);
  REQUIRE(body.tracked);
  // East stays +X, up is +Y, so north is -Z.
  CHECK(glm::distance(body.tracker_from_body.position_m, glm::dvec3(1.0, 3.0, -2.0)) < 1e-6);
  CHECK(glm::distance(body.tracker_from_body.direction({1.0, 0.0, 0.0}), glm::dvec3(0.0, 0.0, -1.0)) < 1e-6);
  CHECK(glm::distance(body.tracker_from_body.direction({0.0, 1.0, 0.0}), glm::dvec3(0.0, 1.0, 0.0)) < 1e-6);
}

TEST_CASE("the newest frame wins, whatever order they come in") {
  NatNetSession session = greeted();
  session.take(natnet_emulator::frame({}, moment_at(2, 0.02)), 0.020);
  session.take(natnet_emulator::frame({}, moment_at(1, 0.01)), 0.021);
  session.take(natnet_emulator::frame({}, moment_at(2, 0.02)), 0.022);
  CHECK(session.newest()->number == 2);
  CHECK(session.state(0.03).late == 2);
  // A recording in a loop counts from its start again while the server's clock goes on.
  session.take(natnet_emulator::frame({}, moment_at(0, 0.03)), 0.030);
  CHECK(session.newest()->number == 0);
}

TEST_CASE("a stream is lost 100 ms after its last good frame, to the moment") {
  NatNetSession session = greeted();
  CHECK(session.state(0.0).phase == TrackerPhase::seeking);
  session.take(natnet_emulator::frame({}, moment_at(100, 1.0)), 1.0);
  CHECK(session.state(1.0999).phase == TrackerPhase::tracking);
  NatNetBytes cut = natnet_emulator::frame({}, moment_at(101, 1.05));
  cut.pop_back();
  session.take(cut, 1.05);                                              // damaged
  session.take(natnet_emulator::frame({}, moment_at(99, 0.99)), 1.06);  // overtaken
  const TrackerState lost = session.state(1.1001);
  CHECK(lost.phase == TrackerPhase::lost);
  REQUIRE(lost.fault.has_value());
  CHECK(lost.fault->code == "tracker.lost");
  CHECK(lost.fault->where == "natnet: 127.0.0.1:1510");
  CHECK(lost.damaged == 1);
  CHECK(lost.late == 1);
  CHECK(lost.frames == 1);
  // The server comes back with its clock at zero.
  session.take(natnet_emulator::frame({}, moment_at(1, -90.0)), 2.0);
  CHECK(session.state(2.0).phase == TrackerPhase::tracking);
  CHECK(session.newest()->number == 1);
}

TEST_CASE("a version of unknown layout is refused by name, and the server that replaces it is taken") {
  NatNetSession session = greeted({}, {2, 10});
  session.take(natnet_emulator::frame({3, 1}, moment_at(1, 0.0)), 0.1);
  const TrackerState state = session.state(0.1);
  CHECK(state.phase == TrackerPhase::refused);
  REQUIRE(state.fault.has_value());
  CHECK(state.fault->code == "natnet.version");
  CHECK(state.fault->message.find("2.10") != std::string::npos);
  CHECK_FALSE(session.newest());
  CHECK(session.due(0.5) == std::vector<NatNetBytes>{ping_message()});
  session.take(natnet_emulator::server_info({4, 0}, ticks_per_s, 1511, true), 0.6);
  session.take(natnet_emulator::frame({4, 0}, moment_at(1, 0.6)), 0.61);
  CHECK(session.state(0.62).phase == TrackerPhase::tracking);
}

TEST_CASE("a silent server and a server without frames are told apart") {
  const NatNetSession silent({}, 0.0);
  CHECK_FALSE(silent.state(0.5).fault.has_value());
  REQUIRE(silent.state(1.5).fault.has_value());
  CHECK(silent.state(1.5).fault->code == "natnet.no-answer");
  const NatNetSession idle = greeted();
  REQUIRE(idle.state(1.5).fault.has_value());
  CHECK(idle.state(1.5).fault->code == "natnet.no-frames");
}

TEST_CASE("frames before the server said who it is are not guessed at") {
  NatNetSession session({}, 0.0);
  session.take(natnet_emulator::frame({}, moment_at(1, 0.0)), 0.0);
  CHECK_FALSE(session.newest());
  CHECK(session.state(0.0).phase == TrackerPhase::seeking);
}

}  // namespace
}  // namespace focalstage
