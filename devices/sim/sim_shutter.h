#pragma once

#include <deque>

#include "devices/roles/rig.h"

namespace focalstage {

struct SimShutterSettings {
  double open_s = 0.0030;   ///< from closed to clear: the crystal relaxes
  double close_s = 0.0001;  ///< from clear to closed: the voltage forces it
};

/// A liquid-crystal shutter: its transmission runs straight from where it is to 0 or 1. Clear until told otherwise, as
/// without voltage.
class SimShutter {
 public:
  explicit SimShutter(const SimShutterSettings& settings) : settings_(settings) {}

  void command(ShutterLevel level, double time_s);

  double at(double time_s) const;
  Transmission during(double from_s, double to_s) const;

  void forget_before(double time_s);

  void set_late(double seconds) { late_s_ = seconds; }

 private:
  struct Corner {
    double time_s;
    double transmission;
  };

  SimShutterSettings settings_;
  double late_s_ = 0.0;
  std::deque<Corner> corners_{{-1e300, 1.0}};
};

}  // namespace focalstage
