#include "devices/runtime/rig_setup.h"

#include "devices/runtime/sim_description.h"

namespace focalstage {

namespace {

std::vector<LightTargetConfig> targets_of(const SimSettings& settings) {
  std::vector<LightTargetConfig> targets;
  for (std::size_t k = 0; k < settings.light->lines.size(); ++k) {
    LightTargetConfig target{settings.light->lines[k].power_d, settings.light->spread_d, {}};
    for (const Side eye : both_sides) {
      target.rectangle_px[eye] = line_rectangle_px(k, eye, settings.width_px, settings.height_px);
    }
    targets.push_back(target);
  }
  return targets;
}

}  // namespace

RigSetup simulated_rig(const SimSettings& settings, const SimFaults& faults) {
  RigSetup setup;
  setup.describe = [=](const RigLimits& limits, double hz) { return describe_sim(settings, limits, hz); };
  if (!settings.light) {
    setup.make = [=] { return std::make_unique<SimRig>(settings, faults); };
    return setup;
  }
  const auto sensor = std::make_shared<SimLightSensor>(*settings.light);
  setup.make = [=] { return std::make_unique<SimRig>(settings, faults, sensor); };
  setup.light_sensor = sensor;
  setup.light_targets = targets_of(settings);
  return setup;
}

}  // namespace focalstage
