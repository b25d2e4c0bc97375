#include "devices/service/osc_desk.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include <spdlog/spdlog.h>

#include "devices/runtime/address.h"
#include "devices/runtime/sockets.h"
#include "devices/service/osc_packet.h"

namespace focalstage {

namespace {

std::string ip_of(const sockaddr_storage& from) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (from.ss_family == AF_INET) {
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(&from)->sin_addr, text.data(), text.size());
  } else {
    inet_ntop(AF_INET6, &reinterpret_cast<const sockaddr_in6*>(&from)->sin6_addr, text.data(), text.size());
  }
  const std::string ip = text.data();
  return ip.starts_with("::ffff:") ? ip.substr(7) : ip;
}

}  // namespace

Result<std::unique_ptr<OscDesk>> OscDesk::start(const OscConfig& config, std::function<void(const DeskCommand&)> obey) {
  const Result<HostPort> address = host_port(config.listen);
  if (!address) return address.fault();
  Result<BoundSocket> socket = bind_socket(*address, SOCK_DGRAM);
  if (!socket) return socket.fault();
  return std::unique_ptr<OscDesk>(new OscDesk(config, std::move(obey), socket->descriptor, socket->address));
}

OscDesk::OscDesk(OscConfig config, std::function<void(const DeskCommand&)> obey, int socket, std::string address)
    : config_(std::move(config)),
      obey_(std::move(obey)),
      socket_(socket),
      address_(std::move(address)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

OscDesk::~OscDesk() {
  thread_.request_stop();
  thread_.join();
  close(socket_);
}

void OscDesk::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    pollfd watched{socket_, POLLIN, 0};
    if (poll(&watched, 1, 100) <= 0) continue;
    while (!stop.stop_requested() && receive()) continue;
  }
}

/// False where nothing waits to be heard.
bool OscDesk::receive() {
  std::array<std::byte, most_osc_bytes + 1> packet{};
  sockaddr_storage from{};
  socklen_t from_size = sizeof from;
  const ssize_t count =
      recvfrom(socket_, packet.data(), packet.size(), MSG_DONTWAIT, reinterpret_cast<sockaddr*>(&from), &from_size);
  if (count < 0) return false;
  const std::string peer = ip_of(from);
  const bool known = peer.starts_with("127.") || peer == "::1" || std::ranges::count(config_.peers, peer) > 0;
  if (!known) {
    if (remarks_.take()) spdlog::warn("osc: {} may not command this rig; list it among osc.peers if it should", peer);
    return true;
  }
  const auto messages = osc_messages(std::span(packet).first(static_cast<std::size_t>(count)));
  for (const OscMessage& message : messages) {
    const auto command = desk_command(message, config_.prefix);
    if (!command) continue;
    if (command->kind == DeskCommand::Kind::blackout || commands_.take()) obey_(*command);
  }
  return true;
}

}  // namespace focalstage
