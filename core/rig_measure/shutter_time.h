#pragma once

#include <string>

#include "core/base/result.h"
#include "core/rig_measure/light_trace.h"
#include "core/rig_measure/measurement.h"

namespace focalstage {

/// One change of a shutter as it was told.
struct ShutterChange {
  bool opens = false;
  double told_s = 0.0;   ///< from the sync edge
  double until_s = 0.0;  ///< nothing else is told before
};

/// How well light and time are known apart from that.
struct ShutterLook {
  double step_s = 0.0;          ///< between the sensor's samples
  double level_spread = 0.0;    ///< FullLight::level_spread
  double delay_spread_s = 0.0;  ///< of the sensor's own delay
};

/// How long the change takes, in milliseconds, from the command on: until the straight line through the passages of
/// 10 % and 90 % of the way is at its end, and until the light is within 2 % of it, whichever is later. So a shutter
/// that runs straight has its whole run, and one with a slow tail is waited for. The spread is that of the estimate
/// over groups of traces (delete-a-group jackknife), of the sensor's step and delay, of full light's own level, and of
/// gaps in the light where it passes 10 % and 90 %.
///
/// `shares`: light behind the shutter as a share of that behind the open one, in time order. "measure.shutter": it does
/// not move, lets light through when closed, or moves on to the end of what was seen; `where` names it.
Result<Estimate> shutter_time_ms(const std::vector<LightPoint>& shares, const ShutterChange& change,
                                 const ShutterLook& look, const std::string& where);

/// Which sensor saw which shutter open: the swing of each, as shares of the range. "measure.swapped" where the other
/// one answered, "measure.leak" where both did.
Status own_side(double own_swing, double other_swing, const std::string& where);

}  // namespace focalstage
