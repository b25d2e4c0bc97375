#include "devices/player/sweep_plan.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace focalstage {

namespace {

Fault broken(const std::string& where, const std::string& message) {
  return {"show.schedule", where, message, "compile the show again"};
}

bool is_time(double time_s, double period_s) { return std::isfinite(time_s) && std::abs(time_s) <= 2.0 * period_s; }

Status check_slot(const ShowHeader& show, std::size_t i) {
  const Slot& slot = show.schedule.slots[i];
  const double period_s = show.schedule.period_s;
  const std::string where = "/projector/0/slot " + std::to_string(i);
  if (slot.image < 0 || static_cast<std::size_t>(slot.image) >= show.images.size()) {
    return broken(where, "there is no image " + std::to_string(slot.image));
  }
  if (!is_time(slot.trigger_s, period_s) || !is_time(slot.start_s, period_s)) {
    return broken(where, "its times are not times of the period");
  }
  if (!(slot.exposure_s > 0.0 && slot.exposure_s < period_s)) return broken(where, "its exposure is no exposure");
  if (std::abs(slot.exposure_s - show.schedule.slots[0].exposure_s) > 1e-9) {
    return broken(where, "a projector has one exposure time, and this one differs from the first");
  }
  if (i > 0 && slot.trigger_s <= show.schedule.slots[i - 1].trigger_s) {
    return broken(where, "its trigger does not come after the one before");
  }
  return {};
}

Status check_schedule(const ShowHeader& show) {
  const Schedule& schedule = show.schedule;
  if (!(schedule.period_s > 1e-4 && schedule.period_s < 10.0)) return broken("/", "the period is not a sweep's");
  if (!(show.rate_hz > 0.0) || show.frames < 1) return broken("/", "there are no frames to play");
  if (schedule.lens_drive_a.left.size() != schedule.lens_drive_a.right.size()) {
    return broken("/lens/drive_a", "the two lenses have different numbers of samples");
  }
  for (const Side eye : both_sides) {
    if (schedule.lens_drive_a[eye].empty()) return broken("/lens/drive_a", "there is no drive");
    const ShutterTimes& times = schedule.shutter[eye];
    if (!is_time(times.open_s, schedule.period_s) || !is_time(times.close_s, schedule.period_s)) {
      return broken(eye == Side::left ? "/shutter/left_s" : "/shutter/right_s", "these are not times of the period");
    }
  }
  for (std::size_t i = 0; i < schedule.slots.size(); ++i) {
    if (Status slot = check_slot(show, i); !slot) return slot;
  }
  return {};
}

}  // namespace

bool SweepPlan::moves_as(const SweepPlan& other) const {
  return period_s == other.period_s && drive_step_s == other.drive_step_s && drive_a == other.drive_a &&
         shutters == other.shutters;
}

bool SweepPlan::fires_as(const SweepPlan& other) const {
  return trigger_s == other.trigger_s && exposure_s == other.exposure_s && form == other.form;
}

Result<SweepPlan> sweep_plan(const ShowHeader& show, int bits) {
  if (Status sound = check_schedule(show); !sound) return sound.fault();
  const Schedule& schedule = show.schedule;
  SweepPlan plan;
  plan.period_s = schedule.period_s;
  plan.exposure_s = schedule.slots.empty() ? 1.0 / show.frames_per_second : schedule.slots[0].exposure_s;
  plan.form = {show.channels, bits};
  plan.drive_a = schedule.lens_drive_a;
  plan.drive_step_s = schedule.period_s / static_cast<double>(schedule.lens_drive_a.left.size());
  for (const Slot& slot : schedule.slots) {
    plan.trigger_s.push_back(slot.trigger_s);
    plan.image.push_back(slot.image);
  }
  for (const Side eye : both_sides) {
    plan.shutters.push_back({eye, ShutterLevel::open, schedule.shutter[eye].open_s});
    plan.shutters.push_back({eye, ShutterLevel::closed, schedule.shutter[eye].close_s});
  }
  std::ranges::stable_sort(plan.shutters, {}, &ShutterCommand::time_s);
  plan.sweeps_per_frame = std::max(1, static_cast<int>(std::lround(1.0 / (schedule.period_s * show.rate_hz))));
  return plan;
}

}  // namespace focalstage
