#include "devices/natnet/receiver.h"

#include <poll.h>

#include <chrono>
#include <system_error>
#include <utility>

#include "devices/roles/clock.h"

namespace focalstage {

namespace {

// How long a wish to stop, or something due, may wait; a datagram is read when it comes.
constexpr int tick_ms = 10;
// From one socket in a row, so that a flood does not keep the others and the keep-alive waiting.
constexpr int most_in_a_row = 64;
constexpr std::size_t longest_datagram = 65536;

}  // namespace

Status NatNetReceiver::start() {
  const std::lock_guard starting(starting_);
  if (thread_.joinable()) return {};
  if (const Status opened = open(); !opened) {
    sockets_.clear();
    return opened;
  }
  {
    const std::lock_guard lock(mutex_);
    session_.emplace(settings_, monotonic_s());
  }
  try {
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  } catch (const std::system_error& error) {
    sockets_.clear();
    const std::lock_guard lock(mutex_);
    session_.reset();
    return Fault{"natnet.thread", "natnet", std::string("no thread can be had: ") + error.what(), ""};
  }
  return {};
}

void NatNetReceiver::stop() {
  const std::lock_guard starting(starting_);
  if (!thread_.joinable()) return;
  thread_.request_stop();
  thread_.join();
  sockets_.clear();
  const std::lock_guard lock(mutex_);
  session_.reset();
}

std::shared_ptr<const TrackedFrame> NatNetReceiver::newest() const {
  const std::lock_guard lock(mutex_);
  return session_ ? session_->newest() : nullptr;
}

TrackerState NatNetReceiver::state() const {
  const std::lock_guard lock(mutex_);
  return session_ ? session_->state(monotonic_s()) : TrackerState{};
}

Status NatNetReceiver::open() {
  const auto server = udp_address(settings_.server, settings_.command_port);
  if (!server) return server.fault();
  server_ = *server;
  const auto local = udp_address(settings_.local, 0);
  if (!local) return local.fault();
  auto commands = UdpSocket::bound(*local);
  if (!commands) return commands.fault();
  sockets_.push_back(std::move(commands).value());
  if (settings_.cast == NatNetCast::unicast && settings_.data_port == 0) return {};
  const bool unicast = settings_.cast == NatNetCast::unicast;
  const auto at = udp_address(unicast ? settings_.local : settings_.group, settings_.data_port);
  if (!at) return at.fault();
  auto data = unicast ? UdpSocket::bound(*at) : UdpSocket::member(*at, *local);
  if (!data) return data.fault();
  sockets_.push_back(std::move(data).value());
  return {};
}

void NatNetReceiver::run(const std::stop_token& stop) {
  std::vector<pollfd> polled;
  for (const UdpSocket& socket : sockets_) polled.push_back({socket.descriptor(), POLLIN, 0});
  std::vector<std::uint8_t> buffer(longest_datagram);
  while (!stop.stop_requested()) {
    send_due();
    ::poll(polled.data(), polled.size(), tick_ms);
    for (const UdpSocket& socket : sockets_) drain(socket, buffer);
  }
}

void NatNetReceiver::drain(const UdpSocket& socket, std::vector<std::uint8_t>& buffer) {
  for (int i = 0; i < most_in_a_row; ++i) {
    const auto datagram = socket.receive(buffer);
    if (!datagram) return;
    if (datagram->from.host != server_.host) continue;
    const std::lock_guard lock(mutex_);
    session_->take(datagram->bytes, monotonic_s());
  }
}

void NatNetReceiver::send_due() {
  std::vector<NatNetBytes> messages;
  {
    const std::lock_guard lock(mutex_);
    messages = session_->due(monotonic_s());
  }
  for (const NatNetBytes& message : messages) sockets_.front().send(message, server_);
}

}  // namespace focalstage
