#pragma once

#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <string>

#include <arpa/inet.h>
#include <netinet/in.h>

#include "devices/runtime/address.h"

namespace focalstage {

/// A TCP connection to an address of this machine; -1 where there is none.
inline int connect_to(const std::string& address) {
  const Result<HostPort> where = host_port(address);
  if (!where) return -1;
  const int descriptor = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const timeval patience{5, 0};
  setsockopt(descriptor, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(where->port));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(descriptor, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0) return descriptor;
  ::close(descriptor);
  return -1;
}

/// All that comes until the other end closes, or five seconds pass in silence.
inline std::string read_all(int descriptor) {
  std::string text;
  char bytes[4096];
  for (;;) {
    const ssize_t count = ::recv(descriptor, bytes, sizeof bytes, 0);
    if (count <= 0) return text;
    text.append(bytes, static_cast<std::size_t>(count));
  }
}

/// What is answered to `request`.
inline std::string ask(const std::string& address, const std::string& request) {
  const int descriptor = connect_to(address);
  if (descriptor < 0) return {};
  (void)::send(descriptor, request.data(), request.size(), MSG_NOSIGNAL);
  const std::string answer = read_all(descriptor);
  ::close(descriptor);
  return answer;
}

}  // namespace focalstage
