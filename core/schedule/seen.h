#pragma once

#include <vector>

#include "core/base/sides.h"
#include "core/optics/power_share.h"
#include "core/schedule/schedule.h"

namespace focalstage {

/// How long a liquid-crystal shutter takes to change.
struct ShutterSpeed {
  double open_s = 0.003;
  double close_s = 0.0001;

  bool operator==(const ShutterSpeed&) const = default;
};

ShutterSpeed shutter_speed(const Glasses& glasses);

/// What one shutter lets through over the period, once it repeats: its transmission runs straight from where it is to 1
/// when told to open and to 0 when told to close.
class ShutterCurve {
 public:
  ShutterCurve(const ShutterTimes& told, const ShutterSpeed& speed, double period_s);

  double transmission(double time_s) const;

 private:
  ShutterTimes told_;
  ShutterSpeed speed_;
  double period_s_;
  double at_opening_ = 0.0;  ///< what it lets through when told to open
  double at_closing_ = 1.0;
};

/// One exposure of the period as one eye gets it.
struct SeenExposure {
  int image = -1;   ///< in the image plan
  bool own = true;  ///< meant for this eye; else its light leaks in
  std::vector<PowerShare> powers;

  bool operator==(const SeenExposure&) const = default;
};

/// Every exposure of the period whose light reaches `eye`, in time order: also the other eye's while this one's shutter
/// is not closed. Each is cut into `parts` of equal length: the lens power and the transmission in the middle of each.
std::vector<SeenExposure> seen_exposures(const Schedule& schedule, const ShutterSpeed& speed, Side eye, int parts = 32);

}  // namespace focalstage
