#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "devices/input/settings.h"
#include "devices/roles/motion_input.h"

namespace focalstage {

/// What one report of a SpaceMouse says; counts of its own axes.
struct SpaceMouseReport {
  std::optional<std::array<std::int16_t, 3>> push;
  std::optional<std::array<std::int16_t, 3>> turn;
  std::optional<std::uint32_t> buttons;

  bool operator==(const SpaceMouseReport&) const = default;
};

/// A report as it comes from the device, its number first. Report 1 has the pushes, with the turns behind them where it
/// is 13 bytes or longer (newer devices); else those come in report 2; report 3 has the buttons. None for any other.
std::optional<SpaceMouseReport> spacemouse_report(std::span<const std::uint8_t> bytes);

/// What the reports until now come to. Pure: told the time.
class SpaceMouseAxes {
 public:
  explicit SpaceMouseAxes(const SpaceMouseSettings& settings) : settings_(settings) {}

  void take(const SpaceMouseReport& report, double now_s);

  /// Zero where no report came for `silence_s`.
  Deflection deflection(double now_s) const;

 private:
  double share(int own) const;

  SpaceMouseSettings settings_;
  std::array<std::int16_t, 6> counts_{};
  std::uint32_t buttons_ = 0;
  double moved_s_ = -1e300;  ///< when the newest report with axes came
};

}  // namespace focalstage
