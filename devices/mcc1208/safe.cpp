#include "devices/mcc1208/safe.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "devices/roles/clock.h"

namespace focalstage {

namespace {

constexpr double step_s = 0.002;
constexpr double longest_ramp_s = 0.06;

struct EnableLine {
  int port;
  std::uint8_t on;
  std::uint8_t off;
};

std::optional<EnableLine> enable_line(const Mcc1208Settings& settings) {
  if (!settings.enable_bit || *settings.enable_bit < 0 || *settings.enable_bit > 15) return std::nullopt;
  const auto bit = static_cast<std::uint8_t>(1 << (*settings.enable_bit % 8));
  const std::uint8_t none = 0;
  return EnableLine{*settings.enable_bit / 8, settings.enable_high ? bit : none, settings.enable_high ? none : bit};
}

// From `from` to the zero-current code; the last step is left to the caller.
Status ramp(MccUnit& unit, int from, const Mcc1208Settings& settings) {
  const double lasts_s = std::clamp(settings.ramp_s, 0.0, longest_ramp_s);
  const double start_s = monotonic_s();
  for (double now_s = start_s; now_s < start_s + lasts_s; now_s = monotonic_s()) {
    const double left = 1.0 - (now_s - start_s) / lasts_s;
    const int code = settings.zero_code + static_cast<int>(std::lround(left * (from - settings.zero_code)));
    if (const Status set = unit.set_output(0, code); !set) return set;
    sleep_until(std::min(now_s + step_s, start_s + lasts_s));
  }
  return {};
}

void keep_first(Status& kept, const Status& status) {
  if (kept && !status) kept = status;
}

}  // namespace

Status prepare_enable(MccUnit& unit, const Mcc1208Settings& settings) {
  const auto line = enable_line(settings);
  if (!line) return {};
  if (const Status low = unit.set_latch(line->port, line->off); !low) return low;  // before it becomes an output
  return unit.set_port_out(line->port);
}

Status set_enable(MccUnit& unit, const Mcc1208Settings& settings, bool enabled) {
  const auto line = enable_line(settings);
  if (!line) return {};
  return unit.set_latch(line->port, enabled ? line->on : line->off);
}

Status bring_to_zero(MccUnit& unit, const Mcc1208Settings& settings) {
  Status kept;
  if (settings.amperes_per_volt != 0.0) {
    const auto outputs = unit.outputs();
    if (outputs && (*outputs)[0] != settings.zero_code) keep_first(kept, ramp(unit, (*outputs)[0], settings));
    if (!outputs) keep_first(kept, outputs.fault());
    if (!kept && kept.fault().code == "usb.lost") return kept;
    const Status zero = unit.set_output(0, settings.zero_code);
    keep_first(kept, zero);
    if (zero) keep_first(kept, unit.set_output(1, 0));
  }
  keep_first(kept, set_enable(unit, settings, false));
  return kept;
}

}  // namespace focalstage
