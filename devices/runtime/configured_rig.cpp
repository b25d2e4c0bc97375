#include "devices/runtime/configured_rig.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/schedule/sweep_shape.h"
#include "devices/catalog/catalog.h"
#include "devices/catalog/device_drivers.h"
#include "devices/rig/device_rig.h"
#include "devices/runtime/tracker_setup.h"

namespace focalstage {

namespace {

/// Straight between the measured points; `frequency_hz` lies within them.
LensHarmonic at(const std::vector<ResponsePoint>& points, int harmonic, double frequency_hz) {
  const auto above = std::ranges::lower_bound(points, frequency_hz, {}, &ResponsePoint::frequency_hz);
  if (above->frequency_hz == frequency_hz) return {harmonic, above->gain_d_per_a, above->phase_deg, {}};
  const auto below = above - 1;
  const double share = (frequency_hz - below->frequency_hz) / (above->frequency_hz - below->frequency_hz);
  return {harmonic,
          std::lerp(below->gain_d_per_a, above->gain_d_per_a, share),
          std::lerp(below->phase_deg, above->phase_deg, share),
          {}};
}

LensResponse response_of(const std::vector<ResponsePoint>& points, double frequency_hz) {
  LensResponse response;
  for (int n = 0; n <= most_shaped_harmonics; ++n) {
    if (n * frequency_hz > points.back().frequency_hz) break;
    response.push_back(at(points, n, n * frequency_hz));
  }
  return response;
}

}  // namespace

RigLimits limits_of(const RigConfig& config) {
  return {config.limits.lens_current_max_a, config.limits.shutter_changes_per_s_max, config.limits.light_share_max};
}

RigDescription describe_measured(const RigConfig& config, const RigLimits& limits, double frequency_hz) {
  RigDescription rig;
  rig.name = config.name.empty() ? "rig" : config.name;
  rig.kind = config.devices.projector ? config.devices.projector->driver : "devices";
  rig.projectors.push_back(config.measured->projector);
  rig.glasses = config.measured->glasses;
  for (const Side eye : both_sides) {
    rig.glasses.lens_response[eye] = response_of(config.measured->response[eye], frequency_hz);
  }
  rig.frequency_hz = frequency_hz;
  rig.lens_current_max_a = limits.lens_current_max_a;
  rig.shutter_changes_per_s_max = limits.shutter_changes_per_s_max;
  return rig;
}

Result<RigSetup> rig_of(const RigConfig& config) {
  if (config.kind == RigKind::devices) {
    Result<RigDevices> devices = make_rig_devices(config.devices);
    if (!devices) return devices.fault();
    RigSetup setup;
    setup.make = [made = std::move(*devices)] { return std::make_unique<DeviceRig>(made, DeviceRigSettings{}); };
    setup.describe = [config](const RigLimits& limits, double hz) { return describe_measured(config, limits, hz); };
    return setup;
  }
  RigSetup setup = simulated_rig();
  if (config.name.empty()) return setup;
  setup.describe = [plain = std::move(setup.describe), name = config.name](const RigLimits& limits, double hz) {
    RigDescription rig = plain(limits, hz);
    rig.name = name;
    return rig;
  };
  return setup;
}

Result<RuntimeOptions> runtime_options(const RigConfig& config) {
  Result<RigSetup> rig = rig_of(config);
  if (!rig) return rig.fault();
  RuntimeOptions options;
  options.listen = config.listen;
  options.store = config.store;
  options.rig.rig = std::move(*rig);
  options.rig.limits = limits_of(config);
  options.network = config.network;
  options.clients = config.clients;
  options.drivers = device_drivers();
  if (config.devices.tracker) {
    Result<TrackerSetup> tracker = tracker_setup(*config.devices.tracker);
    if (!tracker) return tracker.fault();
    options.tracker = std::move(*tracker);
  }
  return options;
}

}  // namespace focalstage
