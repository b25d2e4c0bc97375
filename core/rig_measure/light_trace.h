#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace focalstage {

/// What a light sensor saw in one go, as shares of its range. Times are the rig's: from the sync edge, in the rig's own
/// seconds.
struct LightTrace {
  double first_s = 0.0;
  double step_s = 0.0;
  std::vector<double> light;  ///< 0..1

  double time_s(std::size_t i) const { return first_s + static_cast<double>(i) * step_s; }
};

/// Several goes at the same thing, each begun a little later within a step than the one before: so they see between
/// each other's samples, and their differences are the spread.
using LightTraces = std::vector<LightTrace>;

/// Light at one instant of the period.
struct LightPoint {
  double time_s = 0.0;
  double value = 0.0;
  int trace = 0;  ///< which of the traces it came from
};

/// How dark it is where nothing is lit.
struct DarkLight {
  double level = 0.0;
  double noise = 0.0;   ///< standard deviation of single samples about it, hum in it
  double steady = 0.0;  ///< half the swing of what comes back in every period: hum in step with the sweep
};

/// "measure.saturated" where ambient light alone leaves no room; "measure.light" without samples.
Result<DarkLight> dark_light(const LightTraces& dark);

/// The light that the projector gives at each instant where nothing stands in its way: what all else is held against,
/// so that gaps between its exposures and their unevenness do not matter.
class FullLight {
 public:
  /// "measure.light" (none came, or too little over noise), "measure.saturated", "measure.hum": `where` names which.
  static Result<FullLight> make(const LightTraces& lit, const DarkLight& dark, const std::string& where);

  /// Every sample of `traces` that fell into the light, as a share of it, in time order.
  std::vector<LightPoint> shares(const LightTraces& traces) const;

  double swing() const { return swing_; }  ///< of the sensor's range
  double level_spread() const {
    return level_spread_;
  }  ///< of its level, as a share of it: noise and hum of each trace
  double from_s() const { return times_.front(); }
  double to_s() const { return times_.back(); }

 private:
  std::optional<double> at(double time_s) const;

  double dark_ = 0.0;
  double swing_ = 0.0;
  double level_spread_ = 0.0;
  double first_s_ = 0.0;
  double step_s_ = 0.0;
  std::vector<double> times_;
  std::vector<double> light_;  ///< less the dark, evenly apart
};

/// How many samples stand at the sensor's end, as a share of all.
double saturated_share(const LightTraces& traces);

}  // namespace focalstage
