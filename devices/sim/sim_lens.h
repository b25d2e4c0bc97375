#pragma once

#include <cstddef>
#include <deque>
#include <vector>

namespace focalstage {

/// A tunable lens as a linear time-invariant system: a static gain, a first-order lag and a transport delay,
/// H(s) = gain exp(-s delay) / (1 + s lag).
struct SimLensSettings {
  double gain_d_per_a = 38.0;
  double lag_s = 0.0006;
  double delay_s = 0.0001;
};

/// Gain and phase at one frequency; a lag is a negative phase.
struct LensPoint {
  double gain_d_per_a = 0.0;
  double phase_deg = 0.0;
};

LensPoint lens_point(const SimLensSettings& settings, double frequency_hz);

/// The lens and its waveform generator, whose output runs straight from sample to sample. The equation of the lag is
/// solved exactly on each of these straight pieces.
class SimLens {
 public:
  explicit SimLens(const SimLensSettings& settings);

  /// Plays `drive_a` over and over from `time_s` on, in place of what played before.
  void play(std::vector<double> drive_a, double step_s, double time_s);

  /// Starts the period again at `time_s`: a sync edge without a refill.
  void restart(double time_s);

  /// No current from `time_s` on.
  void stop(double time_s);

  /// The power at `time_s`, not before what was forgotten.
  double power_d(double time_s);

  void forget_before(double time_s);

  void add_lag(double seconds) { settings_.delay_s += seconds; }
  void scale_gain(double factor) { gain_factor_ = factor; }

 private:
  struct Knot {
    double time_s;
    double drive_a;
    double state_a;  ///< the lagged drive; times the gain it is the power
  };

  void cut_at(double time_s);
  void extend_to(double time_s);
  void append(double time_s, double drive_a);
  double state_within(const Knot& from, const Knot& to, double time_s) const;

  SimLensSettings settings_;
  double gain_factor_ = 1.0;
  std::deque<Knot> knots_;
  std::vector<double> drive_a_;
  double step_s_ = 0.0;
  double played_from_s_ = 0.0;
  std::size_t next_sample_ = 0;
};

}  // namespace focalstage
