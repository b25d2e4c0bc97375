#pragma once

#include "core/base/result.h"
#include "core/rig_measure/light_trace.h"
#include "core/rig_measure/measurement.h"

namespace focalstage {

struct LightEdge {
  Estimate latency_ms;  ///< from the trigger to the middle of the rise
  Estimate rise_ms;     ///< 10 to 90 %, projector and sensor together
};

/// When the light of one exposure comes, after its trigger at `trigger_s`. The middle of a rise is where as much light
/// is missing after it as came before it: a sum over samples, which no noise makes pass twice. Sensor and projector
/// cannot be told apart, so half the rise goes into the spread.
///
/// "measure.light", "measure.latency": no exposure was seen, or it begins before its trigger.
Result<LightEdge> light_edge(const LightTraces& traces, const DarkLight& dark, double trigger_s, double exposure_s);

}  // namespace focalstage
