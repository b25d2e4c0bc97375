#include "devices/lightcrafter/packets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace focalstage::lightcrafter {

namespace {

constexpr std::uint8_t flag_nack = 0x20;
constexpr std::uint8_t flag_reply = 0x40;
constexpr std::uint8_t flag_read = 0x80;

std::uint8_t byte_of(std::uint64_t value, int index) { return static_cast<std::uint8_t>(value >> (8 * index) & 0xFFU); }

bool bit(std::uint8_t byte, int index) { return (byte >> index & 1) != 0; }

void put(Bytes& to, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) to.push_back(byte_of(value, i));
}

Bytes message(std::uint8_t flags, std::uint8_t sequence, Command command, std::span<const std::uint8_t> payload) {
  Bytes bytes{flags, sequence};
  put(bytes, payload.size() + 2, 2);
  put(bytes, static_cast<std::uint16_t>(command), 2);
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  return bytes;
}

std::uint16_t word_at(std::span<const std::uint8_t> data, std::size_t at) {
  return static_cast<std::uint16_t>(data[at] | data[at + 1] << 8);
}

}  // namespace

std::string name_of(Command command) {
  std::array<char, 8> text{};
  const auto value = static_cast<unsigned>(command);
  std::snprintf(text.data(), text.size(), "%02X %02X", value >> 8, value & 0xFFU);
  return text.data();
}

Bytes write_message(Command command, std::uint8_t sequence, std::span<const std::uint8_t> payload) {
  return message(flag_reply, sequence, command, payload);
}

Bytes read_message(Command command) { return message(flag_read | flag_reply, 0, command, {}); }

std::vector<Report> reports_of(std::span<const std::uint8_t> message) {
  std::vector<Report> reports((message.size() + 63) / 64);
  for (std::size_t i = 0; i < message.size(); ++i) reports[i / 64][i % 64] = message[i];
  return reports;
}

std::optional<Answer> parse_answer(const Report& report) {
  const std::size_t length = word_at(report, 2);
  if (length > report.size() - 4) return std::nullopt;
  const auto data = std::span(report).subspan(4, length);
  return Answer{(report[0] & flag_nack) != 0, (report[0] & flag_read) != 0, report[1], {data.begin(), data.end()}};
}

std::uint32_t lut_word(const LutEntry& entry) {
  return static_cast<std::uint32_t>(entry.trigger) | (entry.pattern & 0x3FU) << 2 | (entry.bits & 0xFU) << 8 |
         (entry.leds & 7U) << 12 | (entry.invert ? 1U << 16 : 0U) | (entry.black_after ? 1U << 17 : 0U) |
         (entry.buffer_swap ? 1U << 18 : 0U) | (entry.keep_trigger_out ? 1U << 19 : 0U);
}

Bytes lut_bytes(std::span<const LutEntry> entries) {
  Bytes bytes;
  for (const LutEntry& entry : entries) put(bytes, lut_word(entry), 3);
  return bytes;
}

Bytes variable_bytes(const LutEntry& entry, std::uint32_t exposure_us, std::uint32_t period_us) {
  Bytes bytes;
  put(bytes, lut_word(entry), 4);
  put(bytes, exposure_us, 4);
  put(bytes, period_us, 4);
  return bytes;
}

Bytes variable_config_bytes(int entries, int per_trigger_2, int images, bool repeat) {
  Bytes bytes;
  put(bytes, static_cast<std::uint64_t>(entries - 1), 2);
  put(bytes, static_cast<std::uint64_t>(per_trigger_2 - 1), 2);
  put(bytes, static_cast<std::uint64_t>(images - 1), 1);
  put(bytes, repeat ? 1 : 0, 1);
  return bytes;
}

Bytes pattern_config_bytes(int entries, int per_trigger_2, int images, bool repeat) {
  return {byte_of(static_cast<std::uint64_t>(entries - 1), 0), static_cast<std::uint8_t>(repeat ? 1 : 0),
          byte_of(static_cast<std::uint64_t>(per_trigger_2 - 1), 0),
          byte_of(static_cast<std::uint64_t>(images - 1), 0)};
}

Bytes exposure_bytes(std::uint32_t exposure_us, std::uint32_t period_us) {
  Bytes bytes;
  put(bytes, exposure_us, 4);
  put(bytes, period_us, 4);
  return bytes;
}

Bytes led_current_bytes(double brightness) {
  const double cut = brightness > 0.0 ? std::min(brightness, 1.0) : 0.0;  // what is not a number is dark
  return Bytes(3, static_cast<std::uint8_t>(255 - std::lround(cut * 255.0)));
}

HardwareStatus hardware_status(std::uint8_t byte) {
  return {bit(byte, 0), bit(byte, 1), bit(byte, 2), bit(byte, 3), bit(byte, 6), bit(byte, 7)};
}

std::string trouble_in(const HardwareStatus& status) {
  if (!status.initialised) return "it is not initialised";
  if (status.incompatible) return "controller and mirrors do not fit together";
  if (status.reset_error) return "its mirror controller reports an error";
  if (status.buffer_error) return "a forced buffer swap failed";
  if (status.sequencer_abort) return "its sequencer aborted";
  if (status.sequencer_error) return "its sequencer reports an error";
  return {};
}

MainStatus main_status(std::uint8_t byte) { return {bit(byte, 0), bit(byte, 1), bit(byte, 2)}; }

Validation validation(std::uint8_t byte) {
  return {bit(byte, 7), bit(byte, 0), bit(byte, 1), bit(byte, 2), bit(byte, 3), bit(byte, 4)};
}

std::optional<Version> application_version(std::span<const std::uint8_t> data) {
  if (data.size() < 16) return std::nullopt;
  return Version{data[3], data[2], word_at(data, 0)};
}

std::optional<VideoSignal> video_signal(std::span<const std::uint8_t> data) {
  if (data.size() < 28) return std::nullopt;
  return VideoSignal{word_at(data, 20), word_at(data, 22)};
}

}  // namespace focalstage::lightcrafter
