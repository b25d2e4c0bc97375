#include "devices/optotune/packets.h"

#include <algorithm>
#include <cmath>

namespace focalstage {

namespace {

constexpr int full_scale = 4095;
constexpr std::size_t around_payload = 4;  // checksum and CRLF
constexpr std::size_t error_payload = 2;   // 'E' and its number

OptotuneCommand command(std::string_view name, const OptotuneBytes& data, std::size_t answer) {
  OptotuneCommand made{{name.begin(), name.end()}, answer, name};
  made.bytes.insert(made.bytes.end(), data.begin(), data.end());
  const std::uint16_t crc = optotune_crc(made.bytes);
  made.bytes.push_back(static_cast<std::uint8_t>(crc & 0xff));
  made.bytes.push_back(static_cast<std::uint8_t>(crc >> 8));
  return made;
}

OptotuneBytes big_endian(int value, std::size_t zeros = 0) {
  OptotuneBytes bytes(2 + zeros);
  bytes[0] = static_cast<std::uint8_t>(value >> 8 & 0xff);
  bytes[1] = static_cast<std::uint8_t>(value & 0xff);
  return bytes;
}

OptotuneAnswer whole(std::span<const std::uint8_t> bytes, std::size_t payload) {
  if (bytes.size() < payload + around_payload) return {};
  const bool ended = bytes[payload + 2] == '\r' && bytes[payload + 3] == '\n';
  if (!ended || optotune_crc(bytes.first(payload + 2)) != 0) return {OptotuneReading::damaged, {}, 0};
  return {OptotuneReading::good, {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(payload)}, 0};
}

}  // namespace

std::uint16_t optotune_crc(std::span<const std::uint8_t> bytes) {
  unsigned crc = 0;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? crc >> 1 ^ 0xa001 : crc >> 1;
  }
  return static_cast<std::uint16_t>(crc);
}

OptotuneCommand optotune_ask_lens_serial() { return command("X", {}, 9); }
OptotuneCommand optotune_ask_firmware_type() { return command("H", {}, 2); }
OptotuneCommand optotune_ask_version() { return command("V", {}, 7); }
OptotuneCommand optotune_ask_device_id() { return command("IR", OptotuneBytes(8, 0), 10); }
OptotuneCommand optotune_ask_mode() { return command("MMA", {}, 4); }
OptotuneCommand optotune_ask_temperature() { return command("TCA", {}, 5); }
OptotuneCommand optotune_ask_status() { return command("Sr", {}, 5); }
OptotuneCommand optotune_ask_current() { return command("Ar", {0, 0}, 3); }
OptotuneCommand optotune_ask_most_current() { return command("CrMA", {0, 0}, 5); }
OptotuneCommand optotune_set_most_current(int centi_ma) { return command("CwMA", big_endian(centi_ma), 5); }
OptotuneCommand optotune_set_upper_limit(int counts, bool wide) {
  return command("CwUA", big_endian(counts, wide ? 2 : 0), 5);
}
OptotuneCommand optotune_set_lower_limit(int counts, bool wide) {
  return command("CwLA", big_endian(counts, wide ? 2 : 0), 5);
}
OptotuneCommand optotune_set_current(int counts) { return command("Aw", big_endian(counts), 0); }

std::optional<OptotuneCommand> optotune_set_mode(OptotuneMode mode) {
  switch (mode) {
    case OptotuneMode::current:
      return command("MwDA", {}, 3);
    case OptotuneMode::sine:
      return command("MwSA", {}, 3);
    case OptotuneMode::triangle:
      return command("MwTA", {}, 3);
    case OptotuneMode::square:
      return command("MwQA", {}, 3);
    case OptotuneMode::focal_power:
      return command("MwCA", {}, 8);
    case OptotuneMode::analogue:
      return command("MwAA", {}, 3);
    case OptotuneMode::position:
      break;
  }
  return std::nullopt;
}

OptotuneAnswer read_optotune(std::span<const std::uint8_t> bytes, std::size_t answer) {
  if (bytes.empty()) return {};
  if (bytes[0] != 'E') {  // no payload begins with it but a refusal
    if (answer == 0) return {OptotuneReading::damaged, {}, 0};
    return whole(bytes, answer);
  }
  OptotuneAnswer refusal = whole(bytes, error_payload);
  if (refusal.reading != OptotuneReading::good) return refusal;
  const int id = refusal.payload[1] >= '0' ? refusal.payload[1] - '0' : refusal.payload[1];  // 01 or '1'
  return {OptotuneReading::refused, {}, id};
}

std::optional<int> optotune_number(std::span<const std::uint8_t> payload) {
  if (payload.size() < 3) return std::nullopt;  // a letter at least comes before it
  const std::size_t at = payload.size() - 2;
  return static_cast<std::int16_t>(payload[at] << 8 | payload[at + 1]);
}

std::optional<std::string> optotune_version(std::span<const std::uint8_t> payload) {
  if (payload.size() != 7 || payload[0] != 'V') return std::nullopt;
  return std::to_string(payload[1]) + "." + std::to_string(payload[2]) + "." +
         std::to_string(payload[3] << 8 | payload[4]) + "." + std::to_string(payload[5] << 8 | payload[6]);
}

double optotune_celsius(int counts) { return 0.0625 * counts; }

int optotune_counts(double amperes, double most_a) {
  if (!(most_a > 0.0) || std::isnan(amperes)) return 0;
  return static_cast<int>(std::trunc(std::clamp(amperes / most_a, -1.0, 1.0) * full_scale));
}

double optotune_amperes(int counts, double most_a) { return counts * most_a / full_scale; }

std::optional<OptotuneStatus> optotune_status(std::span<const std::uint8_t> payload) {
  if (payload.size() != 5 || payload[0] != 'S') return std::nullopt;
  const unsigned bits = payload[4];
  return OptotuneStatus{(bits & 1) != 0, (bits & 2) != 0, (payload[3] & 1) != 0, (bits & 0x20) != 0,
                        (bits & 0x40) != 0};
}

}  // namespace focalstage
