#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/sides.h"
#include "devices/roles/device.h"

namespace focalstage {

struct DriveAbilities {
  bool eyes_apart = false;          ///< a channel for each lens; else both get the same current
  bool sync_edge = true;            ///< gives out one edge at the start of each period
  double most_a = 0.0;              ///< either way: what goes beyond is cut by the driver, whatever it is told
  std::optional<int> most_samples;  ///< of a period; more are sampled again
  bool steers = false;              ///< its periods may be drawn out and shifted while they play
};

/// One period of current, uniform samples from its start; played over and over.
struct DrivePeriod {
  double period_s = 0.0;
  PerEye<std::vector<double>> drive_a;  ///< both the same where the eyes are not apart

  bool operator==(const DrivePeriod&) const = default;
};

struct DriveReport {
  std::uint64_t periods = 0;     ///< begun since `start`
  double newest_period_s = 0.0;  ///< about when the newest began, on the monotonic clock
  double period_s = 0.0;         ///< as given out, by the device's own clock: what it could make of the one asked for
  std::uint64_t underruns = 0;   ///< gaps: the host came too late
  std::uint64_t clamped = 0;     ///< samples that were beyond the limit
  double edge_late_s = 0.0;      ///< how much later than their periods sync edges are given out, in the mean
};

/// What gives the lenses their current, and the rig its beat. No current flows before `start` and after `stop`.
class LensDrive : public Device {
 public:
  virtual DriveAbilities abilities() const = 0;

  /// "drive.unable": a period that it cannot make, or eyes that differ where it has one channel. A gap stops it: the
  /// state says so.
  virtual Status start(const DrivePeriod& period) = 0;

  /// Plays this from a period's start on, without a gap; says which one, counted as `DriveReport::periods` counts.
  virtual Result<std::uint64_t> refill(const DrivePeriod& period) = 0;

  /// From the next period that is not given away yet, its periods last so long by its own clock, and once come so much
  /// later (earlier, where negative), a hundredth of each at a time. "drive.unable" where the abilities do not have it,
  /// and beyond a hundredth of the period that it was started with.
  virtual Status steer(double period_s, double later_s);

  /// To zero within 100 ms, without a jump where the device allows; safe to call from a watchdog. False: it could not
  /// be told.
  virtual bool stop() noexcept = 0;

  virtual DriveReport report() const = 0;
};

}  // namespace focalstage
