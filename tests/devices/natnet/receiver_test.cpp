#include "devices/natnet/receiver.h"

#include <chrono>
#include <functional>
#include <memory>
#include <thread>

#include <doctest/doctest.h>

#include "tests/devices/natnet/emulator/server.h"

namespace focalstage {
namespace {

using natnet_emulator::Dialect;
using natnet_emulator::Misbehaviour;
using natnet_emulator::Options;
using natnet_emulator::Server;

double steady_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Long waits are for crowded machines; what is meant to happen happens in milliseconds.
bool within(double seconds, const std::function<bool()>& holds) {
  for (const double end_s = steady_s() + seconds; steady_s() < end_s;) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return holds();
}

constexpr double patience_s = 20.0;
constexpr std::uint32_t localhost = 0x7f000001;

/// A port that nobody has: taken, seen and given back.
std::uint16_t free_port() {
  const auto probe = UdpSocket::bound({localhost, 0});
  REQUIRE(probe.ok());
  return probe->port();
}

NatNetSettings unicast_of(const Server& server) {
  NatNetSettings settings;
  settings.local = "127.0.0.1";
  settings.command_port = server.command_port();
  settings.cast = NatNetCast::unicast;
  settings.data_port = 0;
  settings.ping_s = 0.02;
  settings.keep_alive_s = 0.05;
  return settings;
}

bool named(const Tracker& tracker) {
  const auto frame = tracker.newest();
  return frame && frame->bodies.at(0).name == "Head" && frame->bodies.at(1).name == "Box";
}

void check_head(const TrackedFrame& frame) {
  REQUIRE(frame.bodies.size() == 2);
  const TrackedBody& head = frame.bodies[0];
  CHECK(head.id == 7);
  CHECK(head.tracked);
  const auto at = natnet_emulator::head_position(frame.time_s);
  CHECK(glm::distance(head.tracker_from_body.position_m, glm::dvec3(at[0], at[1], at[2])) < 1e-6);
  REQUIRE(frame.latency_s.has_value());
  CHECK(*frame.latency_s == doctest::Approx(Server::latency_s).epsilon(1e-4));
}

/// A server that has a client which got named frames.
struct Pair {
  std::unique_ptr<Server> server;
  std::unique_ptr<NatNetReceiver> receiver;

  explicit Pair(const Dialect& dialect = {}) {
    Options options;
    options.dialect = dialect;
    server = Server::start(options);
    REQUIRE(server);
    receiver = std::make_unique<NatNetReceiver>(unicast_of(*server));
    REQUIRE(receiver->start().ok());
    REQUIRE(within(patience_s, [&] { return named(*receiver); }));
  }
};

TEST_CASE("poses, names and latency come through in every layout") {
  for (const Dialect& dialect : {Dialect{3, 0}, {3, 1}, {4, 0, false}, {4, 0, true}, {4, 1}}) {
    const Pair pair(dialect);
    check_head(*pair.receiver->newest());
    CHECK(pair.receiver->state().damaged == 0);
    CHECK(pair.server->record().unknown == 0);
  }
}

TEST_CASE("frames to the data port are read too") {
  const std::uint16_t port = free_port();
  Options options;
  options.stream_to_data_port = true;
  options.data_port = port;
  const auto server = Server::start(options);
  REQUIRE(server);
  NatNetSettings settings = unicast_of(*server);
  settings.data_port = port;
  NatNetReceiver receiver(settings);
  REQUIRE(receiver.start().ok());
  CHECK(within(patience_s, [&] { return named(receiver); }));
}

TEST_CASE("multicast") {
  Options options;
  options.group = "239.255.42.99";
  options.data_port = free_port();
  const auto server = Server::start(options);
  REQUIRE(server);
  NatNetSettings settings = unicast_of(*server);
  settings.cast = NatNetCast::multicast;
  settings.data_port = options.data_port;
  NatNetReceiver receiver(settings);
  NatNetReceiver second(settings);
  REQUIRE(receiver.start().ok());
  REQUIRE(second.start().ok());
  CHECK(within(patience_s, [&] { return named(receiver) && named(second); }));
}

TEST_CASE("a stream that ends is named lost 100 ms after its last frame, and is taken up again") {
  const Pair pair;
  Misbehaviour silent;
  silent.silent = true;
  pair.server->misbehave(silent);
  CHECK(within(patience_s, [&] { return pair.receiver->state().phase == TrackerPhase::lost; }));
  const double noticed_s = steady_s();
  const double sent_s = pair.server->record().last_sent_s.value();
  MESSAGE("noticed " << (noticed_s - sent_s) * 1e3 << " ms after the last frame was sent");
  CHECK(noticed_s - pair.receiver->newest()->arrival_s >= 0.1);
  const TrackerState lost = pair.receiver->state();
  REQUIRE(lost.fault.has_value());
  CHECK(lost.fault->code == "tracker.lost");
  const int pings = pair.server->record().pings;
  CHECK(within(patience_s, [&] { return pair.server->record().pings > pings; }));
  pair.server->misbehave({});
  CHECK(within(patience_s, [&] { return pair.receiver->state().phase == TrackerPhase::tracking; }));
}

TEST_CASE("lost, overtaken and cut frames") {
  const Pair pair;
  Misbehaviour how;
  how.drop_every = 3;
  how.swap_pairs = true;
  pair.server->misbehave(how);
  CHECK(within(patience_s, [&] { return pair.receiver->state().late >= 20; }));
  std::int64_t newest = 0;
  for (int i = 0; i < 100; ++i) {
    const auto frame = pair.receiver->newest();
    CHECK(frame->number >= newest);
    newest = frame->number;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  check_head(*pair.receiver->newest());
  CHECK(pair.receiver->state().damaged == 0);

  how = {};
  how.cut_bytes = 1;
  pair.server->misbehave(how);
  CHECK(within(patience_s, [&] { return pair.receiver->state().phase == TrackerPhase::lost; }));
  CHECK(pair.receiver->state().damaged > 0);
}

TEST_CASE("a body that is not seen, or is nowhere, is not tracked while the other is") {
  const Pair pair;
  Misbehaviour lost;
  lost.tracking_lost = true;
  Misbehaviour nowhere;
  nowhere.nan_pose = true;
  for (const Misbehaviour& how : {lost, nowhere}) {
    pair.server->misbehave({});
    CHECK(within(patience_s, [&] { return pair.receiver->newest()->bodies.at(0).tracked; }));
    pair.server->misbehave(how);
    CHECK(within(patience_s, [&] { return !pair.receiver->newest()->bodies.at(0).tracked; }));
    CHECK(pair.receiver->newest()->bodies.at(1).tracked);
  }
}

TEST_CASE("keep-alives keep a unicast server streaming") {
  Options options;
  options.patience_s = 0.5;
  const auto server = Server::start(options);
  REQUIRE(server);
  NatNetReceiver receiver(unicast_of(*server));
  REQUIRE(receiver.start().ok());
  CHECK(within(patience_s, [&] { return server->record().keep_alives >= 20; }));
  CHECK(within(patience_s, [&] { return receiver.state().phase == TrackerPhase::tracking; }));
}

TEST_CASE("an unknown version is refused, and another server in its place is taken") {
  Options options;
  options.dialect = {5, 0};
  const auto server = Server::start(options);
  REQUIRE(server);
  NatNetReceiver receiver(unicast_of(*server));
  REQUIRE(receiver.start().ok());
  CHECK(within(patience_s, [&] { return receiver.state().phase == TrackerPhase::refused; }));
  CHECK_FALSE(receiver.newest());
  server->speak({4, 1});
  CHECK(within(patience_s, [&] { return named(receiver); }));
}

TEST_CASE("only the server's address is heard") {
  const auto server = UdpSocket::bound({localhost, 0});
  const auto other = UdpSocket::bound({localhost + 1, 0});
  REQUIRE(server.ok());
  REQUIRE(other.ok());
  NatNetSettings settings;
  settings.local = "127.0.0.1";
  settings.command_port = server->port();
  settings.cast = NatNetCast::unicast;
  settings.data_port = free_port();
  NatNetReceiver receiver(settings);
  REQUIRE(receiver.start().ok());
  const auto speak = [&](const UdpSocket& from) {
    natnet_emulator::Moment moment;
    moment.sent = 1;
    from.send(natnet_emulator::server_info({}, 1000, 1511, false), {localhost, settings.data_port});
    from.send(natnet_emulator::frame({}, moment), {localhost, settings.data_port});
    return receiver.newest() != nullptr;
  };
  CHECK_FALSE(within(0.2, [&] { return speak(*other); }));
  CHECK(within(patience_s, [&] { return speak(*server); }));
}

TEST_CASE("starting and stopping") {
  NatNetSettings settings;
  settings.server = "rig.example";
  NatNetReceiver nowhere(settings);
  const Status refused = nowhere.start();
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.fault().code == "natnet.address");
  CHECK(nowhere.state().phase == TrackerPhase::off);

  const auto taken = UdpSocket::bound({localhost, 0});
  REQUIRE(taken.ok());
  settings.server = "127.0.0.1";
  settings.local = "127.0.0.1";
  settings.cast = NatNetCast::unicast;
  settings.data_port = taken->port();
  NatNetReceiver second(settings);
  const Status busy = second.start();
  REQUIRE_FALSE(busy.ok());
  CHECK(busy.fault().code == "natnet.socket");

  const Pair pair;
  for (int i = 0; i < 3; ++i) {
    pair.receiver->stop();
    pair.receiver->stop();
    CHECK(pair.receiver->state().phase == TrackerPhase::off);
    CHECK_FALSE(pair.receiver->newest());
    CHECK(pair.receiver->start().ok());
    CHECK(pair.receiver->start().ok());
    CHECK(within(patience_s, [&] { return named(*pair.receiver); }));
  }
}

}  // namespace
}  // namespace focalstage
