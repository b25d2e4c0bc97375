#include "devices/sim/sim_rig.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace focalstage {

namespace {
// How far back a question about lens or shutter may reach: the longest exposure and lag, with room.
constexpr double remembered_s = 0.25;
// How many instants of an exposure are looked at for the highest and lowest power: 31 us apart at 0.5 ms.
constexpr int looks = 16;
}  // namespace

SimRig::SimRig(const SimSettings& settings, const SimFaults& faults, std::shared_ptr<SimLightSensor> sensor)
    : lens_{SimLens(settings.lens.left), SimLens(settings.lens.right)},
      shutter_{SimShutter(settings.shutter), SimShutter(settings.shutter)},
      projector_(settings.projector),
      sensor_(std::move(sensor)),
      width_px_(settings.width_px),
      height_px_(settings.height_px) {
  for (const Side eye : both_sides) {
    lens_[eye].add_lag(faults.lens_lag_s);
    lens_[eye].scale_gain(faults.lens_gain);
    shutter_[eye].set_late(faults.shutter_late_s[eye]);
  }
  if (faults.drop_trigger) projector_.drop_trigger_after(*faults.drop_trigger);
}

void SimRig::set_exposure(double exposure_s, PictureForm form) {
  next_edge_.exposure_s = exposure_s;
  form_ = form;
}

void SimRig::set_drive(Side eye, std::span<const double> drive_a, double step_s) {
  next_edge_.drive[eye] = Drive{{drive_a.begin(), drive_a.end()}, step_s};
}

void SimRig::post_images(std::vector<Picture> pictures) {
  projector_.post(std::move(pictures));
  next_edge_.posted = true;
}

void SimRig::sync_edge(double time_s) {
  if (!next_edge_.posted) projector_.post({});
  events_.emplace(time_s, std::exchange(next_edge_, {}));
}

void SimRig::trigger(double time_s) { events_.emplace(time_s, TriggerEvent{}); }

void SimRig::shutter(Side eye, ShutterLevel level, double time_s) { events_.emplace(time_s, ShutterEvent{eye, level}); }

void SimRig::dark(double time_s) {
  run_until(time_s);
  events_.clear();
  next_edge_ = {};
  projector_.forget_posted();
  std::erase_if(running_, [&](const StartedExposure& exposure) { return exposure.start_s >= time_s; });
  for (StartedExposure& exposure : running_) exposure.duration_s = time_s - exposure.start_s;
  for (Lit& lit : lit_) lit.exposure.duration_s = std::min(lit.exposure.duration_s, time_s - lit.exposure.start_s);
  for (const Side eye : both_sides) {
    shutter_[eye].command(ShutterLevel::closed, time_s);
    lens_[eye].stop(time_s);
  }
  end_exposures(time_s);
}

void SimRig::run_until(double time_s) {
  while (!events_.empty() && events_.begin()->first <= time_s) {
    const auto next = events_.extract(events_.begin());
    end_exposures(next.key());
    std::visit([&, at_s = next.key()](auto& event) { happen(at_s, event); }, next.mapped());
  }
  end_exposures(time_s);
  if (sensor_) sensor_->look(time_s, [this](Side eye, double at_s) { return seen(eye, at_s); });
  while (!lit_.empty() && lit_.front().exposure.start_s < time_s - remembered_s) lit_.pop_front();
  for (const Side eye : both_sides) {
    shutter_[eye].forget_before(time_s - remembered_s);
    lens_[eye].forget_before(time_s - remembered_s);
  }
}

void SimRig::happen(double time_s, EdgeEvent& edge) {
  if (sensor_) sensor_->sync_edge(time_s);
  if (edge.exposure_s) projector_.set_exposure(*edge.exposure_s);
  projector_.sync_edge();
  for (const Side eye : both_sides) {
    if (auto& drive = edge.drive[eye]) {
      lens_[eye].play(std::move(drive->drive_a), drive->step_s, time_s);
    } else {
      lens_[eye].restart(time_s);
    }
  }
}

void SimRig::happen(double time_s, TriggerEvent&) {
  auto started = projector_.trigger(time_s);
  if (!started) return;
  if (sensor_) lit_.push_back({*started, {}});
  running_.push_back(std::move(*started));
}

void SimRig::happen(double time_s, ShutterEvent& event) { shutter_[event.eye].command(event.level, time_s); }

void SimRig::end_exposures(double time_s) {
  const auto ended = [&](const StartedExposure& exposure) { return exposure.start_s + exposure.duration_s <= time_s; };
  for (StartedExposure& started : running_) {
    if (!ended(started)) continue;
    DeliveredExposure light;
    light.start_s = started.start_s;
    light.duration_s = started.duration_s;
    for (const Side eye : both_sides) {
      light.power_d[eye] = lens_[eye].power_d(started.start_s + 0.5 * started.duration_s);
      light.smear_d[eye] = smear_d(eye, started.start_s, started.start_s + started.duration_s);
      light.transmission[eye] = shutter_[eye].during(started.start_s, started.start_s + started.duration_s);
    }
    light.picture = started.picture;
    delivered_.push_back(std::move(light));
  }
  std::erase_if(running_, ended);
}

/// Through shutter and lens onto the slit of that eye's sensor: all of a wide field whatever the power, and of a line
/// what its defocus leaves, a share that falls as the slit's width over the line's.
double SimRig::seen(Side eye, double time_s) {
  const SimLightSettings& bench = sensor_->settings();
  double light = 0.0;
  for (Lit& lit : lit_) {
    const double since_s = time_s - lit.exposure.start_s;
    if (since_s < 0.0 || since_s >= lit.exposure.duration_s) continue;
    if (!lit.brightness) {
      lit.brightness = brightness_of(lit.exposure.picture, form_, width_px_, height_px_, bench.lines.size());
    }
    light += bench.white * lit.brightness->field;
    for (std::size_t k = 0; k < bench.lines.size(); ++k) {
      const double beyond = std::max(0.0, lit.brightness->line[k][eye] - lit.brightness->field);
      const double off_d = lens_[eye].power_d(time_s) - bench.lines[k].power_d - bench.lines[k].off_d;
      light += bench.line * beyond / std::sqrt(1.0 + off_d * off_d / (bench.slit_d * bench.slit_d));
    }
  }
  return light * shutter_[eye].at(time_s);
}

double SimRig::smear_d(Side eye, double from_s, double to_s) {
  double lowest_d = lens_[eye].power_d(from_s);
  double highest_d = lowest_d;
  for (int i = 1; i <= looks; ++i) {
    const double power_d = lens_[eye].power_d(std::lerp(from_s, to_s, static_cast<double>(i) / looks));
    lowest_d = std::min(lowest_d, power_d);
    highest_d = std::max(highest_d, power_d);
  }
  return highest_d - lowest_d;
}

std::vector<RigPart> SimRig::parts() const {
  // It stands in a room and does not warm.
  DeviceState state{DevicePhase::running, {}, 0.0, {{"left lens", 25.0}, {"right lens", 25.0}, {"projector", 25.0}}};
  return {{{"sim", "simulated rig", "", "in this program"}, std::move(state)}};
}

std::vector<DeliveredExposure> SimRig::take_delivered() { return std::exchange(delivered_, {}); }

}  // namespace focalstage
