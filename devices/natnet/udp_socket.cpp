#include "devices/natnet/udp_socket.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace focalstage {

namespace {

std::string text_of(const UdpAddress& address) {
  const auto part = [&](int shift) { return std::to_string((address.host >> shift) & 0xffU); };
  return part(24) + "." + part(16) + "." + part(8) + "." + part(0) + ":" + std::to_string(address.port);
}

Fault socket_fault(const UdpAddress& address, const std::string& what) {
  const std::string why = std::error_code(errno, std::generic_category()).message();
  return {"natnet.socket", text_of(address), what + ": " + why,
          "see which program has the port, and the local address"};
}

sockaddr_in system_address(const UdpAddress& address) {
  sockaddr_in out{};
  out.sin_family = AF_INET;
  out.sin_addr.s_addr = htonl(address.host);
  out.sin_port = htons(address.port);
  return out;
}

/// The sockets interface takes every kind of address by this one pointer type.
sockaddr* generic(sockaddr_in* address) { return reinterpret_cast<sockaddr*>(address); }

bool bind_to(int descriptor, const UdpAddress& address) {
  sockaddr_in system = system_address(address);
  return ::bind(descriptor, generic(&system), sizeof system) == 0;
}

template <class T>
bool set_option(int descriptor, int level, int name, const T& value) {
  return ::setsockopt(descriptor, level, name, &value, sizeof value) == 0;
}

int open_descriptor() { return ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0); }

}  // namespace

Result<UdpAddress> udp_address(const std::string& dots, std::uint16_t port) {
  in_addr address{};
  if (::inet_pton(AF_INET, dots.c_str(), &address) != 1) {
    return Fault{"natnet.address", dots, "this is no IPv4 address", "write it in dots, such as 192.168.0.7"};
  }
  return UdpAddress{ntohl(address.s_addr), port};
}

Result<UdpSocket> UdpSocket::bound(const UdpAddress& address) {
  UdpSocket socket(open_descriptor());
  if (socket.descriptor_ < 0) return socket_fault(address, "no socket can be had");
  if (!bind_to(socket.descriptor_, address)) return socket_fault(address, "the address cannot be used");
  return socket;
}

Result<UdpSocket> UdpSocket::member(const UdpAddress& group, const UdpAddress& local) {
  UdpSocket socket(open_descriptor());
  const int fd = socket.descriptor_;
  if (fd < 0) return socket_fault(group, "no socket can be had");
  ip_mreq membership{};
  membership.imr_multiaddr.s_addr = htonl(group.host);
  membership.imr_interface.s_addr = htonl(local.host);
  // Bound to the group's own address, Linux hands over nothing that was sent elsewhere.
  if (!set_option(fd, SOL_SOCKET, SO_REUSEADDR, 1) || !bind_to(fd, group)) {
    return socket_fault(group, "the address cannot be used");
  }
  if (!set_option(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, membership)) {
    return socket_fault(group, "the multicast group cannot be joined");
  }
  return socket;
}

UdpSocket::UdpSocket(UdpSocket&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

UdpSocket& UdpSocket::operator=(UdpSocket&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

UdpSocket::~UdpSocket() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::uint16_t UdpSocket::port() const {
  sockaddr_in system{};
  socklen_t size = sizeof system;
  if (::getsockname(descriptor_, generic(&system), &size) != 0) return 0;
  return ntohs(system.sin_port);
}

void UdpSocket::send(std::span<const std::uint8_t> bytes, const UdpAddress& to) const {
  sockaddr_in system = system_address(to);
  (void)::sendto(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL, generic(&system), sizeof system);
}

std::optional<UdpDatagram> UdpSocket::receive(std::span<std::uint8_t> buffer) const {
  sockaddr_in system{};
  socklen_t size = sizeof system;
  const ssize_t got = ::recvfrom(descriptor_, buffer.data(), buffer.size(), 0, generic(&system), &size);
  if (got < 0) return std::nullopt;
  return UdpDatagram{buffer.first(static_cast<std::size_t>(got)),
                     {ntohl(system.sin_addr.s_addr), ntohs(system.sin_port)}};
}

}  // namespace focalstage
