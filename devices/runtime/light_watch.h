#pragma once

#include <functional>

#include "core/base/result.h"
#include "core/rig_measure/light_trace.h"
#include "devices/roles/light_sensor.h"

namespace focalstage {

/// What one eye's sensor is to be asked for, again and again.
struct LightTask {
  Side eye = Side::left;
  double from_s = 0.0;  ///< from the sync edge, in the rig's seconds
  double to_s = 0.0;
  int traces = 24;
};

/// Takes records of a light sensor, one after the other, and puts them on the rig's clock.
class LightWatch {
 public:
  /// `may_go_on` is asked every few milliseconds: a fault of it ends everything.
  LightWatch(LightSensor& sensor, double period_s, std::function<Status()> may_go_on)
      : sensor_(sensor), period_s_(period_s), may_go_on_(std::move(may_go_on)) {}

  /// Each trace begins a part of a step later than the one before. A window that is longer than the sensor takes at
  /// once is put together of pieces, each a trace. "light.silent" where nothing comes for three seconds,
  /// "light.unsynced" where the sensor's sync edges are not the rig's; its own faults.
  Result<LightTraces> traces(const LightTask& task) const;

  double step_s() const { return sensor_.abilities().step_s; }

 private:
  Result<LightTrace> trace(const LightRequest& request) const;

  LightSensor& sensor_;
  double period_s_;
  std::function<Status()> may_go_on_;
};

}  // namespace focalstage
