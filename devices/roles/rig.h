#pragma once

#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/sides.h"
#include "devices/roles/device.h"
#include "devices/roles/rig_port.h"

namespace focalstage {

/// How much light a shutter let through during an exposure: 0..1.
struct Transmission {
  double least = 0.0;
  double most = 0.0;
};

/// Light that left the projector, and what each eye had before it.
struct DeliveredExposure {
  Picture picture;
  double start_s = 0.0;
  double duration_s = 0.0;
  PerEye<double> power_d;             ///< at mid-exposure, through the drive really played
  PerEye<double> smear_d;             ///< the power's highest less its lowest during the exposure
  PerEye<Transmission> transmission;  ///< over the exposure
};

/// One device of a rig, for people.
struct RigPart {
  DeviceId id;
  DeviceState state;
};

/// A rig to play on: simulated, or made of devices. Called by the one thread that keeps its time.
class Rig : public RigPort {
 public:
  /// How many sweeps pass without light wherever lens or shutters begin to move otherwise.
  virtual int settle_sweeps() const = 0;

  /// Whether triggers may come at other times from one sweep to the next; else that takes such sweeps too.
  virtual bool retimes_at_once() const = 0;

  /// All it needs is there and answers; ends what `doubt` says, where that is over. Asked before light may begin.
  virtual Status ready() = 0;

  /// Where the sync edge that is planned for `planned_s` is to be looked for, by the rig's own beat: the plan follows
  /// it.
  virtual double edge_near_s(double planned_s) const = 0;

  /// Lets everything up to `time_s` happen. What is handed over afterwards lies after it.
  virtual void run_until(double time_s) = 0;

  /// Whether it can tell what light came of what it was given.
  virtual bool sees_light() const = 0;

  /// The exposures that ended since the last call, in time order; none from a rig that cannot see them.
  virtual std::vector<DeliveredExposure> take_delivered() = 0;

  /// Why it went dark by itself; stays until `ready`.
  virtual std::optional<Fault> doubt() const = 0;

  /// What it is made of, as it stands now.
  virtual std::vector<RigPart> parts() const = 0;
};

}  // namespace focalstage
