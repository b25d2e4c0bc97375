#pragma once

#include <memory>

#include "core/base/result.h"
#include "devices/rig/score.h"
#include "devices/roles/lens_drive.h"
#include "devices/roles/projector.h"
#include "devices/roles/trigger_board.h"

namespace focalstage {

struct RigDevices {
  std::shared_ptr<ProjectorDevice> projector;
  std::shared_ptr<LensDrive> lens;
  std::shared_ptr<TriggerBoard> board;
};

struct DeviceRigSettings {
  int settle_sweeps = 60;      ///< for lenses to swing in, the board to find the beat, tables to travel
  int following_sweeps = 480;  ///< the same where the projector is the clock: the lens drive comes into step first
  double pulse_s = 100e-6;     ///< of a projector trigger
  double light_goes_first_s = 0.03;  ///< told to be dark, the lens drive waits so long for the light to go out, at most
};

/// Leads the devices of a rig through what was handed over. Has no thread and no clock: `step` is told the time, every
/// millisecond or so.
class Leader {
 public:
  Leader() = default;
  Leader(const Leader&) = delete;
  Leader& operator=(const Leader&) = delete;
  virtual ~Leader() = default;

  virtual void hand_over(HandedSweep sweep) = 0;

  /// A fault is a doubt: whoever leads makes everything dark, and calls `forget`.
  virtual Status step(double now_s) = 0;

  /// Everything is dark now, and begins anew with the next sweep handed over.
  virtual void forget() = 0;

  /// Devices give something out: from now on a device that fails is a doubt.
  virtual bool leads() const = 0;
};

/// As the projector's pacing wants it.
std::unique_ptr<Leader> make_leader(const RigDevices& devices, const DeviceRigSettings& settings);

/// A little of the way from where a sync edge is planned to where the beat of the device that gives it has it.
double edge_near_s(const RigDevices& devices, double planned_s);

}  // namespace focalstage
