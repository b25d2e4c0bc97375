#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/base/result.h"

namespace focalstage {

/// An IPv4 address and a port, both as numbers of this machine's byte order.
struct UdpAddress {
  std::uint32_t host = 0;
  std::uint16_t port = 0;

  bool operator==(const UdpAddress&) const = default;
};

/// "natnet.address" unless `dots` is an IPv4 address such as 192.168.0.7.
Result<UdpAddress> udp_address(const std::string& dots, std::uint16_t port);

/// What came, and from whom. The bytes are those of the buffer given.
struct UdpDatagram {
  std::span<const std::uint8_t> bytes;
  UdpAddress from;
};

/// A UDP socket that never waits. Faults are "natnet.socket".
class UdpSocket {
 public:
  /// Bound to this address; port 0: any free one.
  static Result<UdpSocket> bound(const UdpAddress& address);

  /// Receives what is sent to this multicast group and port, through the interface with the address `local`. Others on
  /// this machine may do so too.
  static Result<UdpSocket> member(const UdpAddress& group, const UdpAddress& local);

  UdpSocket(UdpSocket&& other) noexcept;
  UdpSocket& operator=(UdpSocket&& other) noexcept;
  ~UdpSocket();

  int descriptor() const { return descriptor_; }
  std::uint16_t port() const;

  /// Sends, or loses, as networks do.
  void send(std::span<const std::uint8_t> bytes, const UdpAddress& to) const;

  /// The next datagram, if there is one.
  std::optional<UdpDatagram> receive(std::span<std::uint8_t> buffer) const;

 private:
  explicit UdpSocket(int descriptor) : descriptor_(descriptor) {}

  int descriptor_ = -1;
};

}  // namespace focalstage
