#pragma once

#include <span>
#include <vector>

#include "core/rig_measure/light_trace.h"

namespace focalstage {

/// A curve that never falls.
struct RisingCurve {
  std::vector<double> time_s;
  std::vector<double> value;

  /// When it passes `level` first, straight between its points; its end where it never does.
  double passing_s(double level) const;
};

/// The rising curve nearest to the points (in time order), by least squares: pool adjacent violators (R. E. Barlow et
/// al., "Statistical Inference under Order Restrictions", 1972). What noise would make pass a level twice passes once.
RisingCurve rising_curve(std::span<const LightPoint> points);

}  // namespace focalstage
