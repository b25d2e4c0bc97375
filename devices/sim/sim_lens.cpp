#include "devices/sim/sim_lens.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace focalstage {

namespace {
// Two instants of the generator closer than this are one: far below its step, far above the rounding of a day's clock.
constexpr double same_instant_s = 1e-9;
// The output stage rises and falls within one of its steps; a microsecond is faster than any of them.
constexpr double output_stage_s = 1e-6;
}  // namespace

LensPoint lens_point(const SimLensSettings& settings, double frequency_hz) {
  const double omega = 2.0 * std::numbers::pi * frequency_hz;
  const double turn_rad = -std::atan(omega * settings.lag_s) - omega * settings.delay_s;
  return {settings.gain_d_per_a / std::hypot(1.0, omega * settings.lag_s), turn_rad * 180.0 / std::numbers::pi};
}

SimLens::SimLens(const SimLensSettings& settings) : settings_(settings) {
  knots_.push_back({-std::numeric_limits<double>::max(), 0.0, 0.0});
}

void SimLens::play(std::vector<double> drive_a, double step_s, double time_s) {
  extend_to(time_s - same_instant_s);
  cut_at(time_s);
  if (knots_.back().time_s < time_s - output_stage_s && drive_a_.empty()) {
    append(time_s - output_stage_s, knots_.back().drive_a);
  }
  drive_a_ = std::move(drive_a);
  step_s_ = step_s;
  played_from_s_ = time_s;
  next_sample_ = 0;
}

void SimLens::restart(double time_s) {
  if (!drive_a_.empty()) play(std::vector<double>(drive_a_), step_s_, time_s);
}

void SimLens::stop(double time_s) {
  extend_to(time_s - same_instant_s);
  cut_at(time_s);
  append(time_s, knots_.back().drive_a);
  append(time_s + output_stage_s, 0.0);
  drive_a_.clear();
}

void SimLens::cut_at(double time_s) {
  while (knots_.size() > 1 && knots_.back().time_s > time_s - same_instant_s) knots_.pop_back();
}

void SimLens::append(double time_s, double drive_a) {
  Knot knot{time_s, drive_a, 0.0};
  knot.state_a = state_within(knots_.back(), knot, time_s);
  knots_.push_back(knot);
}

void SimLens::extend_to(double time_s) {
  while (!drive_a_.empty() && knots_.back().time_s < time_s) {
    append(played_from_s_ + static_cast<double>(next_sample_) * step_s_, drive_a_[next_sample_ % drive_a_.size()]);
    ++next_sample_;
  }
}

/// lag x' = u - x with u straight between the knots: x = u - lag u' + (x0 - u0 + lag u') exp(-t / lag).
double SimLens::state_within(const Knot& from, const Knot& to, double time_s) const {
  const double elapsed_s = time_s - from.time_s;
  const double rest = std::exp(-elapsed_s / settings_.lag_s);
  const double length_s = to.time_s - from.time_s;
  const double slope = (to.drive_a - from.drive_a) / length_s;
  const double lagged = settings_.lag_s * slope;
  return from.drive_a + slope * elapsed_s - lagged + (from.state_a - from.drive_a + lagged) * rest;
}

double SimLens::power_d(double time_s) {
  const double at_s = time_s - settings_.delay_s;
  extend_to(at_s);
  const auto after = std::ranges::upper_bound(knots_, at_s, {}, &Knot::time_s);
  const Knot& from = after == knots_.begin() ? knots_.front() : *std::prev(after);
  const Knot to = after == knots_.end() ? Knot{at_s + 1.0, from.drive_a, 0.0} : *after;
  return gain_factor_ * settings_.gain_d_per_a * state_within(from, to, at_s);
}

void SimLens::forget_before(double time_s) {
  const double at_s = time_s - settings_.delay_s;
  while (knots_.size() > 2 && knots_[1].time_s < at_s) knots_.pop_front();
}

}  // namespace focalstage
