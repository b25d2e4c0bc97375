#pragma once

#include "core/base/sides.h"
#include "core/scene/project.h"
#include "core/schedule/schedule.h"

namespace focalstage {

struct TimeSpan {
  double from_s = 0.0;
  double to_s = 0.0;

  double length_s() const { return to_s > from_s ? to_s - from_s : 0.0; }
  bool operator==(const TimeSpan&) const = default;
};

/// What both shutters do in one period.
struct ShutterPlan {
  PerEye<ShutterTimes> told;
  PerEye<TimeSpan> clear;  ///< between the dead windows: own shutter fully open, the other fully closed; may be empty
};

/// The shutters change places in two dead windows, as long as the slower of the two changes: one centred on the
/// period's start, the other on `handover_s`. Left is open between them, right from the handover to the period's end.
///
/// The one that closes is told so as its window begins; the one that opens, so that it is done as the window ends. So
/// neither moves outside a window, and one opens only as the other is closing.
ShutterPlan plan_shutters(const Glasses& glasses, double period_s, double handover_s);

}  // namespace focalstage
