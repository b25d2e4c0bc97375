#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace focalstage {

/// Bytes and numbers of Optotune's Lens Driver 4 and 4i, as its manual and public programs have them. Integers are
/// big-endian; the checksum that ends each packet goes low byte first.

using OptotuneBytes = std::vector<std::uint8_t>;

/// CRC-16/ARC: polynomial 8005h reflected, from 0. Over a packet with its checksum it is 0.
std::uint16_t optotune_crc(std::span<const std::uint8_t> bytes);

/// What is sent, and how many bytes of payload answer it. Ids are the manual's, without the writing of memory, which is
/// never asked for.
struct OptotuneCommand {
  OptotuneBytes bytes;
  std::size_t answer = 0;  ///< bytes before checksum and CRLF; 0: silent where it succeeds
  std::string_view name;   ///< the letters it was sent with
};

enum class OptotuneMode : std::uint8_t { current = 1, sine, triangle, square, focal_power, analogue, position };

inline constexpr std::string_view optotune_start = "Start";      ///< the handshake has no checksum
inline constexpr std::string_view optotune_ready = "Ready\r\n";  ///< its answer

OptotuneCommand optotune_ask_lens_serial();
OptotuneCommand optotune_ask_firmware_type();
OptotuneCommand optotune_ask_version();
OptotuneCommand optotune_ask_device_id();
OptotuneCommand optotune_ask_mode();
OptotuneCommand optotune_ask_temperature();
OptotuneCommand optotune_ask_status();
OptotuneCommand optotune_ask_current();
OptotuneCommand optotune_ask_most_current();
/// In 0.01 mA.
OptotuneCommand optotune_set_most_current(int centi_ma);
/// `wide`: with two more bytes, as some firmware is said to want.
OptotuneCommand optotune_set_upper_limit(int counts, bool wide);
OptotuneCommand optotune_set_lower_limit(int counts, bool wide);
OptotuneCommand optotune_set_current(int counts);
/// None for the mode that has no command of its own (position).
std::optional<OptotuneCommand> optotune_set_mode(OptotuneMode mode);

enum class OptotuneReading {
  more,     ///< the answer is not whole yet
  good,     ///< `payload` is the answer's
  refused,  ///< `error` says why: 1 checksum, 2 not in this firmware, 3 not known, 4 lens does not fit
  damaged,  ///< checksum or end are wrong
};
struct OptotuneAnswer {
  OptotuneReading reading = OptotuneReading::more;
  OptotuneBytes payload;
  int error = 0;
};

/// What came so far, for a command that `answer` bytes answer. The end is found by counting: a payload may hold 0D 0A.
OptotuneAnswer read_optotune(std::span<const std::uint8_t> bytes, std::size_t answer);

/// The big-endian int16 that ends a payload; none where it is too short.
std::optional<int> optotune_number(std::span<const std::uint8_t> payload);
/// "1.12.240.800"
std::optional<std::string> optotune_version(std::span<const std::uint8_t> payload);

/// 0.0625 C per count.
double optotune_celsius(int counts);
/// Full scale is 4095 counts either way; cut to it, and towards zero.
int optotune_counts(double amperes, double most_a);
double optotune_amperes(int counts, double most_a);

/// `Sr`, by bit.
struct OptotuneStatus {
  bool hardware_missing = false;
  bool memory_faulty = false;
  bool lens_unfit = false;     ///< bit 0 of the byte before
  bool lens_too_warm = false;  ///< bit 5, which says as well: focal power beyond what is guaranteed
  bool beyond_user_range = false;

  bool operator==(const OptotuneStatus&) const = default;
};
std::optional<OptotuneStatus> optotune_status(std::span<const std::uint8_t> payload);

}  // namespace focalstage
