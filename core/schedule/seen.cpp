#include "core/schedule/seen.h"

#include <algorithm>
#include <cmath>

#include "core/base/periodic.h"

namespace focalstage {
namespace {

double change(double seconds, double takes_s) { return takes_s > 0.0 ? seconds / takes_s : INFINITY; }

}  // namespace

ShutterSpeed shutter_speed(const Glasses& glasses) {
  return {glasses.shutter_open_ms / 1000.0, glasses.shutter_close_ms / 1000.0};
}

ShutterCurve::ShutterCurve(const ShutterTimes& told, const ShutterSpeed& speed, double period_s)
    : told_(told), speed_(speed), period_s_(period_s) {
  // Both levels follow from each other; each round through the period brings them nearer to what repeats, and two
  // suffice where either change is finished before the other begins.
  for (int round = 0; round < 64; ++round) {
    at_closing_ = std::min(1.0, at_opening_ + change(wrapped_s(told.close_s - told.open_s, period_s), speed.open_s));
    at_opening_ = std::max(0.0, at_closing_ - change(wrapped_s(told.open_s - told.close_s, period_s), speed.close_s));
  }
}

double ShutterCurve::transmission(double time_s) const {
  const double opening_s = wrapped_s(time_s - told_.open_s, period_s_);
  const double closing_s = wrapped_s(time_s - told_.close_s, period_s_);
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
      seen.powers.push_back({periodic_at(schedule.lens_power_d[eye], time_s / schedule.period_s), share});
    }
    if (!seen.powers.empty()) all.push_back(std::move(seen));
  }
  return all;
}

}  // namespace focalstage
