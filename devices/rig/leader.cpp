#include "devices/rig/leader.h"

#include <cmath>

#include "devices/rig/conductor.h"
#include "devices/rig/projector_led.h"

namespace focalstage {

namespace {

// How much of the way to where the devices' beat stands one sweep goes: their reports come with the jitter of their
// lines.
constexpr double follow_share = 0.1;

bool is_master(const RigDevices& devices) { return devices.projector->abilities().pacing == Pacing::master; }

}  // namespace

std::unique_ptr<Leader> make_leader(const RigDevices& devices, const DeviceRigSettings& settings) {
  if (is_master(devices)) return std::make_unique<ProjectorLed>(devices, settings);
  return std::make_unique<Conductor>(devices, settings);
}

double edge_near_s(const RigDevices& devices, double planned_s) {
  const DriveReport drive = devices.lens->report();
  double newest_s = drive.newest_period_s;
  if (drive.periods == 0 || !(drive.period_s > 0.0)) return planned_s;
  if (is_master(devices)) {
    // The drive is in step with it; but only the projector says when.
    const auto projector_s = devices.projector->report().newest_period_s;
    if (!projector_s) return planned_s;
    newest_s = *projector_s;
  }
  const double beat_s = newest_s + std::round((planned_s - newest_s) / drive.period_s) * drive.period_s;
  return planned_s + follow_share * (beat_s - planned_s);
}

}  // namespace focalstage
