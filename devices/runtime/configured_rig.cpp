#include "devices/runtime/configured_rig.h"

#include <utility>

#include "devices/catalog/catalog.h"
#include "devices/catalog/device_drivers.h"
#include "devices/catalog/light_catalog.h"
#include "devices/rig/device_rig.h"
#include "devices/runtime/response_points.h"
#include "devices/runtime/tracker_setup.h"

namespace focalstage {

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
    rig.glasses.lens_response[eye] = response_at(config.measured->response[eye], frequency_hz);
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
    setup.lenses_share_drive = [lens = devices->lens] { return !lens->abilities().eyes_apart; };
    setup.make = [made = std::move(*devices)] { return std::make_unique<DeviceRig>(made, DeviceRigSettings{}); };
    setup.describe = [config](const RigLimits& limits, double hz) { return describe_measured(config, limits, hz); };
    if (config.devices.light_sensor) {
      Result<std::shared_ptr<LightSensor>> sensor = make_light_sensor(config.devices.light_sensor->device);
      if (!sensor) return sensor.fault();
      setup.light_sensor = std::move(*sensor);
      setup.light_targets = config.devices.light_sensor->targets;
    }
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
