#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace focalstage::uno {

/// The line protocol of devices/firmware/README.md, seen from the host. Bytes only: no port, no clock.

/// CRC-16/CCITT-FALSE: polynomial 1021, start FFFF, not reflected.
std::uint16_t crc16(std::string_view bytes);

/// A request as it is sent: number, command, checksum and line feed. Nothing if it would be longer than a line may be
/// (64 bytes) or is not printable ASCII.
std::optional<std::string> request(std::uint8_t number, std::string_view command);

enum class ReplyKind { ok, error, boot, dark, damaged };

/// What one line of the board means.
struct Reply {
  ReplyKind kind = ReplyKind::damaged;
  std::optional<std::uint8_t> number;  ///< of the request that it answers; none: unasked
  unsigned code = 0;                   ///< of an error, a darkness (its reason), a boot (MCUSR)
  unsigned protocol = 0;               ///< of a boot
  std::string words;                   ///< what follows OK

  bool operator==(const Reply&) const = default;
};

/// `line` without its line feed.
Reply decode(std::string_view line);

/// What STAT says.
struct StatusLine {
  enum class State { safe, waiting, running };
  State state = State::safe;
  unsigned reason = 0;
  unsigned tables = 0;
  double period_s = 0.0;  ///< by the board's own clock; 0 without sync
  unsigned edges = 0;
  unsigned bad_lines = 0;
};

std::optional<StatusLine> decode_status(std::string_view words);
/// What LENS says.
struct LensLine {
  double after_s = 0.0;  ///< by the board's own clock
  unsigned edges = 0;
};

std::optional<LensLine> decode_lens(std::string_view words);
/// The protocol's version that a HELLO's answer names.
std::optional<unsigned> decode_hello(std::string_view words);

/// Cuts what a port delivers into lines. One that is too long is dropped whole and comes out as a damaged one.
class ReplyReader {
 public:
  std::optional<Reply> push(char byte);

 private:
  std::string line_;
  bool too_long_ = false;
};

}  // namespace focalstage::uno
