#include "devices/mcc1208/packets.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace focalstage {

namespace {

constexpr double clock_hz = 60e6;
constexpr double most_scans_per_s = 50e3;
constexpr double volts_per_code = 5.0 / 4096.0;
constexpr std::uint8_t both_channels = 0x03;

int u16(std::span<const std::uint8_t> bytes, std::size_t at) { return bytes[at] | bytes[at + 1] << 8; }

}  // namespace

std::optional<MccStatus> read_mcc_status(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != 2) return std::nullopt;
  const int bits = u16(bytes, 0);
  return MccStatus{(bits & 1 << 3) != 0, (bits & 1 << 4) != 0};
}

std::optional<std::array<int, 2>> read_mcc_outputs(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != 4) return std::nullopt;
  const std::array<int, 2> codes{u16(bytes, 0), u16(bytes, 2)};
  if (std::max(codes[0], codes[1]) > mcc_top_code) return std::nullopt;
  return codes;
}

std::optional<std::string> read_mcc_serial(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != 8) return std::nullopt;
  const bool printable =
      std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t byte) { return byte > 0x20 && byte < 0x7f; });
  if (!printable) return std::nullopt;
  return std::string(bytes.begin(), bytes.end());
}

std::array<std::uint8_t, 9> mcc_scan_start(std::uint32_t pacer) {
  std::array<std::uint8_t, 9> bytes{};  // the first four: how many scans, 0 for endless
  for (std::size_t i = 0; i < 4; ++i) bytes[4 + i] = static_cast<std::uint8_t>(pacer >> (8 * i));
  bytes[8] = both_channels;
  return bytes;
}

std::optional<std::uint32_t> mcc_pacer(double scans_per_s) {
  if (!(scans_per_s > 0.0) || scans_per_s > most_scans_per_s) return std::nullopt;
  const double pacer = std::round(clock_hz / scans_per_s) - 1.0;
  if (pacer > static_cast<double>(std::numeric_limits<std::uint32_t>::max())) return std::nullopt;
  return static_cast<std::uint32_t>(pacer);
}

double mcc_scans_per_s(std::uint32_t pacer) { return clock_hz / (static_cast<double>(pacer) + 1.0); }

int mcc_code(double volts) {
  if (std::isnan(volts)) return 0;
  return static_cast<int>(std::clamp(std::round(volts / volts_per_code), 0.0, static_cast<double>(mcc_top_code)));
}

double mcc_volts(int code) { return code * volts_per_code; }

void append_mcc_scan(std::vector<std::uint8_t>& bytes, int code_0, int code_1) {
  for (const int code : {code_0, code_1}) {
    bytes.push_back(static_cast<std::uint8_t>(code & 0xff));
    bytes.push_back(static_cast<std::uint8_t>(code >> 8));
  }
}

}  // namespace focalstage
