#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// What a LightCrafter 4500 (DLPC350) is sent and answers, as bytes: TI DLP ALC LightCrafter SDK, `dlpc350_api.cpp`.
/// Pure.
namespace focalstage::lightcrafter {

using Bytes = std::vector<std::uint8_t>;
using Report = std::array<std::uint8_t, 64>;

inline constexpr std::uint16_t vendor_id = 0x0451;
inline constexpr std::uint16_t product_id = 0x6401;

/// TI writes "1A 24"; on the wire the low byte goes first.
enum class Command : std::uint16_t {
  power = 0x0200,
  version = 0x0205,
  video_signal = 0x071C,
  led_current = 0x0B01,
  input_source = 0x1A00,
  led_enable = 0x1A07,
  hardware_status = 0x1A0A,
  system_status = 0x1A0B,
  main_status = 0x1A0C,
  validate = 0x1A1A,
  display_mode = 0x1A1B,
  trigger_out_1 = 0x1A1D,
  trigger_out_2 = 0x1A1E,
  pattern_source = 0x1A22,
  trigger_mode = 0x1A23,
  pattern_run = 0x1A24,
  exposure = 0x1A29,
  pattern_config = 0x1A31,
  mailbox_address = 0x1A32,
  mailbox_control = 0x1A33,
  mailbox_data = 0x1A34,
  variable_data = 0x1A3E,
  variable_address = 0x1A3F,
  variable_config = 0x1A40,
};
std::string name_of(Command command);

/// A message as a host sends it, without padding. Writes ask for an answer.
Bytes write_message(Command command, std::uint8_t sequence, std::span<const std::uint8_t> payload);
Bytes read_message(Command command);

/// Cut into reports: the first begins with the header, later ones are raw; the last is padded with zeros.
std::vector<Report> reports_of(std::span<const std::uint8_t> message);

struct Answer {
  bool nack = false;
  bool to_read = false;
  std::uint8_t sequence = 0;
  Bytes data;  ///< of a read
};
/// Nothing where the stated length does not fit a report.
std::optional<Answer> parse_answer(const Report& report);

/// One entry of a pattern table.
struct LutEntry {
  enum class Trigger : std::uint8_t { internal, external_positive, external_negative, none };
  Trigger trigger = Trigger::internal;
  std::uint8_t pattern = 0;
  std::uint8_t bits = 8;
  std::uint8_t leds = 7;  ///< bit 0 red, 1 green, 2 blue
  bool invert = false;
  bool black_after = false;
  bool buffer_swap = false;
  bool keep_trigger_out = false;

  bool operator==(const LutEntry&) const = default;
};
std::uint32_t lut_word(const LutEntry& entry);
Bytes lut_bytes(std::span<const LutEntry> entries);  ///< three bytes each, for mailbox 2

/// An entry with times of its own, for mailbox 3.
Bytes variable_bytes(const LutEntry& entry, std::uint32_t exposure_us, std::uint32_t period_us);
/// `entries` and `per_trigger_2` 1..1824.
Bytes variable_config_bytes(int entries, int per_trigger_2, int images, bool repeat);
Bytes pattern_config_bytes(int entries, int per_trigger_2, int images, bool repeat);
Bytes exposure_bytes(std::uint32_t exposure_us, std::uint32_t period_us);

/// The three LED currents for a brightness of 0..1, which is cut to that: the board's LED driver is inverted, 00 is
/// full current. Nothing else knows that.
Bytes led_current_bytes(double brightness);

struct HardwareStatus {
  bool initialised = false;
  bool incompatible = false;
  bool reset_error = false;
  bool buffer_error = false;
  bool sequencer_abort = false;
  bool sequencer_error = false;
};
HardwareStatus hardware_status(std::uint8_t byte);
/// What is wrong, in words; empty if nothing is.
std::string trouble_in(const HardwareStatus& status);

struct MainStatus {
  bool parked = false;
  bool running = false;
  bool frozen = false;
};
MainStatus main_status(std::uint8_t byte);

struct Validation {
  bool busy = false;
  bool bad_timing = false;
  bool bad_pattern = false;
  bool trigger_overlap = false;  ///< a warning, as the next two are
  bool black_missing = false;
  bool short_gap = false;

  bool ok() const { return !busy && !bad_timing && !bad_pattern; }
};
Validation validation(std::uint8_t byte);

struct Version {
  int major = 0;
  int minor = 0;
  int patch = 0;
};
/// The application's, of an answer of 16 bytes.
std::optional<Version> application_version(std::span<const std::uint8_t> data);

struct VideoSignal {
  int active_px = 0;
  int active_lines = 0;
};
/// Of an answer of 28 bytes.
std::optional<VideoSignal> video_signal(std::span<const std::uint8_t> data);

}  // namespace focalstage::lightcrafter
