#include "devices/player/limits.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

namespace focalstage {

namespace {

std::string measured(const char* what, double value, const char* unit, double limit) {
  char text[160];
  std::snprintf(text, sizeof text, "%s %.4g %s is beyond this rig's limit of %.4g %s", what, value, unit, limit, unit);
  return text;
}

}  // namespace

void LimitedRig::refuse(const char* code, const char* where, std::string message) {
  if (fault_) return;
  fault_ = Fault{code, where, std::move(message), "change the show; the limit is the rig's own"};
}

void LimitedRig::set_exposure(double exposure_s, PictureForm form) {
  if (!std::isfinite(exposure_s) || exposure_s <= 0.0) {
    refuse("limit.light", "exposure", "the exposure is not a positive time");
  }
  if (fault_) return;
  exposure_s_ = exposure_s;
  rig_.set_exposure(exposure_s, form);
}

void LimitedRig::announce_triggers(std::span<const double> trigger_s) {
  if (!fault_) rig_.announce_triggers(trigger_s);
}

void LimitedRig::set_drive(Side eye, std::span<const double> drive_a, double step_s) {
  const char* where = eye == Side::left ? "left lens" : "right lens";
  double worst_a = 0.0;
  for (const double current_a : drive_a) {
    worst_a = std::isfinite(current_a) ? std::max(worst_a, std::abs(current_a)) : INFINITY;
  }
  if (worst_a > limits_.lens_current_max_a) {
    refuse("limit.lens-current", where, measured("a current of", worst_a, "A", limits_.lens_current_max_a));
  }
  if (!std::isfinite(step_s) || step_s <= 0.0) {
    refuse("limit.lens-current", where, "the time between drive samples is not a positive time");
  }
  if (!fault_) rig_.set_drive(eye, drive_a, step_s);
}

void LimitedRig::post_images(std::vector<Picture> pictures) {
  if (!fault_) rig_.post_images(std::move(pictures));
}

void LimitedRig::sync_edge(double time_s) {
  if (fault_) return;
  earlier_edge_s_ = std::exchange(edge_s_, time_s);
  lit_in_sweep_ = 0;
  rig_.sync_edge(time_s);
}

void LimitedRig::trigger(double time_s) {
  if (fault_) return;
  ++lit_in_sweep_;
  // The first sweep's length is not known from its edges; the ones before it show nothing (the lenses settle).
  const double sweep_s = edge_s_ - earlier_edge_s_;
  const double share = lit_in_sweep_ * exposure_s_ / sweep_s;
  if (share > limits_.light_share_max) {
    return refuse("limit.light", "lamp",
                  measured("light for a share of", share, "of the sweep", limits_.light_share_max));
  }
  rig_.trigger(time_s);
}

void LimitedRig::shutter(Side eye, ShutterLevel level, double time_s) {
  if (fault_) return;
  if (level == level_[eye]) return;
  // Two changes make a cycle: its length says the rate, however unevenly its halves lie.
  const double cycle_s = time_s - earlier_change_s_[eye];
  const double rate_hz = 2.0 / cycle_s;
  if (!(rate_hz <= limits_.shutter_changes_per_s_max) || cycle_s <= 0.0) {
    return refuse("limit.shutter-rate", eye == Side::left ? "left shutter" : "right shutter",
                  measured("a change rate of", rate_hz, "per second", limits_.shutter_changes_per_s_max));
  }
  level_[eye] = level;
  earlier_change_s_[eye] = std::exchange(last_change_s_[eye], time_s);
  rig_.shutter(eye, level, time_s);
}

void LimitedRig::dark(double time_s) {
  level_ = {ShutterLevel::closed, ShutterLevel::closed};
  last_change_s_ = earlier_change_s_ = {-1e300, -1e300};
  edge_s_ = earlier_edge_s_ = -1e300;
  rig_.dark(time_s);
}

}  // namespace focalstage
