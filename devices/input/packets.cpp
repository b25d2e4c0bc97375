#include "devices/input/packets.h"

#include <algorithm>
#include <cmath>

namespace focalstage {

namespace {

constexpr std::size_t classic_bytes = 7;
constexpr std::size_t combined_bytes = 13;
constexpr std::size_t most_button_bytes = 4;  // of 32 buttons; no device has more

/// Three numbers, the low byte of each first.
std::array<std::int16_t, 3> triple(std::span<const std::uint8_t> bytes) {
  std::array<std::int16_t, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) {
    const unsigned low = bytes[2 * i];
    const unsigned high = bytes[2 * i + 1];
    out[i] = static_cast<std::int16_t>(static_cast<std::uint16_t>(low | (high << 8U)));
  }
  return out;
}

std::uint32_t bit_field(std::span<const std::uint8_t> bytes) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < std::min(bytes.size(), most_button_bytes); ++i) {
    bits |= static_cast<std::uint32_t>(bytes[i]) << (8 * i);
  }
  return bits;
}

}  // namespace

std::optional<SpaceMouseReport> spacemouse_report(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 2) return std::nullopt;
  SpaceMouseReport report;
  const auto body = bytes.subspan(1);
  if (bytes[0] == 3) {
    report.buttons = bit_field(body);
    return report;
  }
  if ((bytes[0] != 1 && bytes[0] != 2) || bytes.size() < classic_bytes) return std::nullopt;
  (bytes[0] == 1 ? report.push : report.turn) = triple(body);
  if (bytes[0] == 1 && bytes.size() >= combined_bytes) report.turn = triple(body.subspan(6));
  return report;
}

void SpaceMouseAxes::take(const SpaceMouseReport& report, double now_s) {
  if (report.buttons) buttons_ = *report.buttons;
  if (now_s - moved_s_ > settings_.silence_s) counts_ = {};  // what was silent is not taken up again
  if (report.push) std::ranges::copy(*report.push, counts_.begin());
  if (report.turn) std::ranges::copy(*report.turn, counts_.begin() + 3);
  if (report.push || report.turn) moved_s_ = now_s;
}

double SpaceMouseAxes::share(int own) const {
  const double counts = counts_[static_cast<std::size_t>(std::clamp(own, 0, 5))];
  const double beyond = std::abs(counts) - settings_.dead_counts;
  if (beyond <= 0.0 || !(settings_.full_counts > settings_.dead_counts)) return 0.0;
  return std::copysign(std::min(1.0, beyond / (settings_.full_counts - settings_.dead_counts)), counts);
}

Deflection SpaceMouseAxes::deflection(double now_s) const {
  Deflection out;
  out.buttons = buttons_;
  if (now_s - moved_s_ > settings_.silence_s) return out;
  for (int i = 0; i < 3; ++i) {
    const SpaceMouseAxis& push = settings_.axes[static_cast<std::size_t>(i)];
    const SpaceMouseAxis& turn = settings_.axes[static_cast<std::size_t>(i + 3)];
    out.push[i] = push.sign * share(push.own);
    out.turn[i] = turn.sign * share(turn.own);
  }
  return out;
}

}  // namespace focalstage
