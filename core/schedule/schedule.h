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
  /// outside_sweep      the sweep never reaches the power. Amount: the power; limit: the sweep's nearer extreme
  /// hidden_by_shutter  a shutter moves, or the eye's half ends, during the exposure. Amount: for how many seconds;
  /// limit 0 overlap            the next exposure starts too soon. Amount: seconds from start to start; limit: as many
  /// as it takes smear              the power changes by too much. Amount: by how much; limit: 0.3 D no_zero_crossing
  /// light for surfaces, and the sweep never passes zero. Amount: its extreme nearest zero; limit 0 bad_waveform the
  /// eye's power is no curve that passes each power once up and once down; nothing is timed
  enum class Kind { outside_sweep, hidden_by_shutter, overlap, smear, no_zero_crossing, bad_waveform };

  Kind kind = Kind::overlap;
  int image = -1;        ///< bad_waveform: none
  int other_image = -1;  ///< overlap: the next one
  Side eye = Side::left;
  double amount = 0.0;
  double limit = 0.0;

  bool operator==(const SlotTrouble&) const = default;
};

struct ScheduleResult {
  Schedule schedule;
  std::vector<SlotTrouble> troubles;
};

/// Times every image of the plan for both eyes (design section 6). What cannot be shown (outside_sweep,
/// hidden_by_shutter, no_zero_crossing, bad_waveform) is left out and named in `troubles`; the schedule holds the rest.
/// Projector number `projector` sets rate, exposure and latency.
ScheduleResult make_schedule(const Project& project, const std::vector<ImageSpec>& images, std::size_t projector = 0);

}  // namespace focalstage
