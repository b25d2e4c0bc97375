#include "devices/runtime/sockets.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace focalstage {

namespace {

constexpr int backlog = 128;

struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t size = 0;

  sockaddr* get() { return reinterpret_cast<sockaddr*>(&storage); }
};

/// False where the host is no numeric address.
bool numeric(const HostPort& address, SocketAddress& into) {
  sockaddr_in v4{};
  v4.sin_family = AF_INET;
  v4.sin_port = htons(static_cast<std::uint16_t>(address.port));
  if (inet_pton(AF_INET, address.host.c_str(), &v4.sin_addr) == 1) {
    std::memcpy(&into.storage, &v4, sizeof v4);
    into.size = sizeof v4;
    return true;
  }
  sockaddr_in6 v6{};
  v6.sin6_family = AF_INET6;
  v6.sin6_port = htons(static_cast<std::uint16_t>(address.port));
  if (inet_pton(AF_INET6, address.host.c_str(), &v6.sin6_addr) != 1) return false;
  std::memcpy(&into.storage, &v6, sizeof v6);
  into.size = sizeof v6;
  return true;
}

int port_of(int descriptor) {
  SocketAddress own;
  own.size = sizeof own.storage;
  if (getsockname(descriptor, own.get(), &own.size) != 0) return 0;
  in_port_t port = 0;  // at the same place in both kinds of address
  static_assert(offsetof(sockaddr_in, sin_port) == offsetof(sockaddr_in6, sin6_port));
  std::memcpy(&port, reinterpret_cast<const char*>(&own.storage) + offsetof(sockaddr_in, sin_port), sizeof port);
  return ntohs(port);
}

}  // namespace

Result<BoundSocket> bind_socket(const HostPort& address, int type) {
  SocketAddress wanted;
  if (!numeric(address, wanted)) {
    return Fault{"runtime.address", text_of(address), "the host is not a numeric address of this machine",
                 "give an IP address, such as 127.0.0.1 or 0.0.0.0"};
  }
  const int descriptor = socket(wanted.storage.ss_family, type | SOCK_CLOEXEC, 0);
  const int yes = 1;
  if (descriptor >= 0 && type == SOCK_STREAM) setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  const bool there = descriptor >= 0 && bind(descriptor, wanted.get(), wanted.size) == 0 &&
                     (type != SOCK_STREAM || listen(descriptor, backlog) == 0);
  if (!there) {
    const std::string problem = std::generic_category().message(errno);
    if (descriptor >= 0) close(descriptor);
    return Fault{"runtime.address-in-use", text_of(address), "this address can't be had: " + problem,
                 "stop who listens there, or choose another"};
  }
  return BoundSocket{descriptor, text_of({address.host, port_of(descriptor)})};
}

}  // namespace focalstage
