#pragma once

#include <sys/socket.h>

#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "devices/plugin/wire_framing.h"

namespace focalstage::wire_emulator {

/// A socket at `path`, made anew, for one plugin to connect to; `flags` beside SOCK_CLOEXEC. -1, and errno, where it
/// cannot be had.
int listen_at(const std::string& path, int flags = 0);

/// Messages out of the stream that a plugin sends, however it comes in pieces.
class WireReader {
 public:
  enum class Got {
    nothing,  ///< more has to come
    header,   ///< of a message that is coming: `header`
    message,  ///< whole: `header` and `body`, until the next call
    end       ///< of the stream
  };

  /// Takes what is there, up to the next header's or message's end. Does not wait. Ask again after a header: a message
  /// may have nothing else.
  Got receive(int connection);

  const wire_header& header() const { return header_; }
  std::span<const std::uint8_t> body() const { return body_; }

 private:
  /// Whether all `bytes` are there.
  Got fill(int connection, std::span<std::uint8_t> bytes, Got whole);

  wire_header header_{};
  std::vector<std::uint8_t> body_;
  std::size_t filled_ = 0;  ///< of what is coming
  bool in_body_ = false;
};

/// The part of a message's body that has a type; none where it is shorter.
template <class Part>
std::optional<Part> part_of(std::span<const std::uint8_t> body) {
  Part part;
  if (body.size() < sizeof part) return std::nullopt;
  std::memcpy(&part, body.data(), sizeof part);
  return part;
}

/// Sends a message whole; false where that cannot be.
template <class Body>
bool say(int connection, std::uint32_t type, const Body& body) {
  const wire_header header{type, 0, sizeof body};
  std::uint8_t message[sizeof header + sizeof body];
  std::memcpy(message, &header, sizeof header);
  std::memcpy(message + sizeof header, &body, sizeof body);
  return ::send(connection, message, sizeof message, MSG_NOSIGNAL) == static_cast<ssize_t>(sizeof message);
}

}  // namespace focalstage::wire_emulator
