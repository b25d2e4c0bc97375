#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/sides.h"
#include "core/scene/project.h"

namespace focalstage {

/// The lens power of one eye over one period (design section 6). It starts at its minimum, rises strictly to its
/// maximum and falls strictly back: each power in between is passed once in each half. The rising half is the left
/// eye's, the falling half the right eye's.
class PowerCurve {
 public:
  /// The curve that `sweep` gives `eye`: a sine, or the measured samples with periodic linear interpolation.
  /// Fault "schedule.waveform": it has no such curve; the message says why.
  static Result<PowerCurve> make(const Sweep& sweep, Side eye);

  double period_s() const { return period_s_; }
  double min_d() const { return min_d_; }
  double max_d() const { return max_d_; }
  double peak_s() const { return peak_s_; }  ///< when the power is highest

  double power_d(double time_s) const;

  /// When the half of `eye` passes `power_d`, in [0, period]; nothing outside [min, max].
  std::optional<double> passing_s(double power_d, Side eye) const;

  /// `count` uniform samples from the period's start.
  std::vector<double> samples_d(std::size_t count) const;

 private:
  PowerCurve() = default;
  double measured_passing_s(double power_d, Side eye) const;

  double period_s_ = 0.0;
  double min_d_ = 0.0;
  double max_d_ = 0.0;
  double peak_s_ = 0.0;
  std::vector<double> measured_d_;  ///< empty: a sine
  std::size_t peak_ = 0;            ///< index of the highest of them
};

/// `count` uniform samples of the periodic, linearly interpolated `samples`. Those given stay as they are where `count`
/// is a multiple of their number.
std::vector<double> resampled(const std::vector<double>& samples, std::size_t count);

/// How many samples of one period the rig is given: 1024, or as many more as keep every measured sample.
///
/// 1024: a converter that draws straight lines between samples shrinks harmonic n by 1 - (pi n / K)^2 / 3, for a sine
/// of 10 D by 3e-5 D; at the edge of a 3 ms dead window that is 0.02 us. Numbers of measured samples whose common
/// multiple is beyond 65536 are resampled to 65536.
std::size_t lens_sample_count(const Sweep& sweep);

}  // namespace focalstage
