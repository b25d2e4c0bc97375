#include "devices/runtime/rig_setup.h"

#include "devices/runtime/sim_description.h"

namespace focalstage {

RigSetup simulated_rig(const SimSettings& settings, const SimFaults& faults) {
  return {[=] { return std::make_unique<SimRig>(settings, faults); },
          [=](const RigLimits& limits, double frequency_hz) { return describe_sim(settings, limits, frequency_hz); }};
}

}  // namespace focalstage
