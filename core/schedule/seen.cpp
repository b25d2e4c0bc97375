#include "core/schedule/seen.h"

#include <algorithm>
#include <cmath>

namespace focalstage {
namespace {

/// From one moment of a period to the next occurrence of another.
double until(double from_s, double to_s, double period_s) {
  const double apart_s = std::fmod(to_s - from_s, period_s);
  return apart_s < 0.0 ? apart_s + period_s : apart_s;
}

double change(double seconds, double takes_s) { return takes_s > 0.0 ? seconds / takes_s : INFINITY; }

/// Periodic, straight between uniform samples.
double power_at(const std::vector<double>& samples_d, double time_s, double period_s) {
  const auto count = static_cast<double>(samples_d.size());
  const double place = until(0.0, time_s, period_s) / period_s * count;
  const double below = std::floor(place);
  const auto low = static_cast<std::size_t>(below) % samples_d.size();
  const auto high = (low + 1) % samples_d.size();
  return samples_d[low] + (place - below) * (samples_d[high] - samples_d[low]);
}

}  // namespace

ShutterSpeed shutter_speed(const Glasses& glasses) {
  return {glasses.shutter_open_ms / 1000.0, glasses.shutter_close_ms / 1000.0};
}

ShutterCurve::ShutterCurve(const ShutterTimes& told, const ShutterSpeed& speed, double period_s)
    : told_(told), speed_(speed), period_s_(period_s) {
  // Both levels follow from each other; each round through the period brings them nearer to what repeats, and two
  // suffice where either change is finished before the other begins.
  for (int round = 0; round < 64; ++round) {
    at_closing_ = std::min(1.0, at_opening_ + change(until(told.open_s, told.close_s, period_s), speed.open_s));
    at_opening_ = std::max(0.0, at_closing_ - change(until(told.close_s, told.open_s, period_s), speed.close_s));
  }
}

double ShutterCurve::transmission(double time_s) const {
  const double opening_s = until(told_.open_s, time_s, period_s_);
  const double closing_s = until(told_.close_s, time_s, period_s_);
  if (opening_s < closing_s) return std::min(1.0, at_opening_ + change(opening_s, speed_.open_s));
  return std::max(0.0, at_closing_ - change(closing_s, speed_.close_s));
}

std::vector<SeenExposure> seen_exposures(const Schedule& schedule, const ShutterSpeed& speed, Side eye, int parts) {
  const ShutterCurve shutter(schedule.shutter[eye], speed, schedule.period_s);
  std::vector<SeenExposure> all;
  for (const Slot& slot : schedule.slots) {
    SeenExposure seen{slot.image, slot.eye == eye, {}};
    for (int part = 0; part < parts; ++part) {
      const double time_s = slot.start_s + slot.exposure_s * (part + 0.5) / parts;
      const double share = shutter.transmission(time_s) / parts;
      if (!(share > 0.0)) continue;
      seen.powers.push_back({power_at(schedule.lens_power_d[eye], time_s, schedule.period_s), share});
    }
    if (!seen.powers.empty()) all.push_back(std::move(seen));
  }
  return all;
}

}  // namespace focalstage
