#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/sides.h"
#include "core/optics/image_plan.h"
#include "core/scene/project.h"

namespace focalstage {

/// One exposure of the period. Times are from the period's start: the minimum of the lens power.
struct Slot {
  int image = -1;  ///< in the image plan
  Side eye = Side::left;
  double start_s = 0.0;
  double exposure_s = 0.0;
  double trigger_s = 0.0;  ///< leads the start by the projector's latency; may be negative (previous period)
  double power_d = 0.0;    ///< lens power at mid-exposure
  double smear_d = 0.0;    ///< size of its change across the exposure

  bool operator==(const Slot&) const = default;
};

/// When a shutter is told to open and to close, in seconds from the period's start, within [0, period).
struct ShutterTimes {
  double open_s = 0.0;
  double close_s = 0.0;

  bool operator==(const ShutterTimes&) const = default;
};

/// What the rig does in one period: the plain values that the show stores.
struct Schedule {
  double period_s = 1.0 / 60.0;
  std::vector<Slot> slots;                   ///< in time order
  PerEye<std::vector<double>> lens_power_d;  ///< one period, uniform samples from the period's start
  PerEye<std::vector<double>> lens_drive_a;  ///< the drive that makes it through the lens response
  PerEye<ShutterTimes> shutter;

  bool operator==(const Schedule&) const = default;
};

/// An exposure that cannot be had, or that comes out wrong, with how much.
struct SlotTrouble {
  enum class Kind { outside_sweep, hidden_by_shutter, overlap, smear, no_zero_crossing };

  Kind kind = Kind::overlap;
  int image = -1;
  int other_image = -1;  ///< overlap: the other one
  Side eye = Side::left;
  double amount = 0.0;   ///< outside_sweep and smear: dioptres; hidden and overlap: seconds
  double limit = 0.0;
};

struct ScheduleResult {
  Schedule schedule;
  std::vector<SlotTrouble> troubles;
};

/// Times every image of the plan for both eyes (design section 6). What cannot be timed is left out and named in
/// `troubles`; the schedule holds the rest. Projector number `projector` sets rate, exposure and latency.
ScheduleResult make_schedule(const Project& project, const std::vector<ImageSpec>& images, std::size_t projector = 0);

}  // namespace focalstage
