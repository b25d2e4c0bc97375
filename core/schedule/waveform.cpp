#include "core/schedule/waveform.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/base/periodic.h"

namespace focalstage {
namespace {

constexpr std::size_t fewest_samples = 1024;
constexpr std::size_t most_samples = 65536;

Fault bad_waveform(const std::string& message) {
  return {"schedule.waveform", "/sweep", message, "sweep from a lower to a higher power, once up and once down"};
}

bool all_finite(const std::vector<double>& samples) {
  return std::all_of(samples.begin(), samples.end(), [](double sample) { return std::isfinite(sample); });
}

/// Why the measured samples are no curve; empty if they are one.
std::string defect_of(const MeasuredWaveform& measured, std::size_t peak) {
  const std::vector<double>& power_d = measured.power_d;
  if (!measured.drive_a.empty() && measured.drive_a.size() != power_d.size()) {
    return "the measured drive has another number of samples than the measured power";
  }
  if (!all_finite(measured.drive_a)) return "a measured drive sample is not a finite number";
  for (std::size_t i = 0; i < power_d.size(); ++i) {
    const double next_d = power_d[(i + 1) % power_d.size()];
    const bool monotonic = i < peak ? power_d[i] < next_d : power_d[i] > next_d;
    if (!monotonic) {
      return "the measured power is not strictly monotonic between its extrema after sample " + std::to_string(i);
    }
  }
  return {};
}

}  // namespace

Result<PowerCurve> PowerCurve::make(const Sweep& sweep, Side eye) {
  if (!std::isfinite(sweep.frequency_hz) || sweep.frequency_hz <= 0.0) {
    return bad_waveform("the sweep's frequency is not a positive number");
  }
  PowerCurve curve;
  curve.period_s_ = 1.0 / sweep.frequency_hz;
  const Waveform& waveform = sweep.waveform[eye];
  if (!waveform) {
    if (!std::isfinite(sweep.min_power_d) || !std::isfinite(sweep.max_power_d)) {
      return bad_waveform("the sweep's extrema are not finite numbers");
    }
    if (!(sweep.min_power_d < sweep.max_power_d)) return bad_waveform("the sweep's minimum is not below its maximum");
    curve.min_d_ = sweep.min_power_d;
    curve.max_d_ = sweep.max_power_d;
    curve.peak_s_ = curve.period_s_ / 2.0;
    return curve;
  }
  const std::vector<double>& power_d = waveform->power_d;
  if (power_d.size() < 2) return bad_waveform("a measured period needs two samples or more");
  if (!all_finite(power_d)) return bad_waveform("a measured power sample is not a finite number");
  const auto highest = std::max_element(power_d.begin(), power_d.end());
  curve.peak_ = static_cast<std::size_t>(highest - power_d.begin());
  if (std::string defect = defect_of(*waveform, curve.peak_); !defect.empty()) return bad_waveform(defect);
  curve.min_d_ = power_d.front();
  curve.max_d_ = *highest;
  curve.peak_s_ = curve.period_s_ * static_cast<double>(curve.peak_) / static_cast<double>(power_d.size());
  curve.measured_d_ = power_d;
  return curve;
}

double PowerCurve::power_d(double time_s) const {
  const double turns = time_s / period_s_;
  if (!measured_d_.empty()) return periodic_at(measured_d_, turns);
  const double phase = turns - std::floor(turns);
  const double middle_d = (min_d_ + max_d_) / 2.0;
  return middle_d - (max_d_ - min_d_) / 2.0 * std::cos(2.0 * std::numbers::pi * phase);
}

std::optional<double> PowerCurve::passing_s(double power_d, Side eye) const {
  if (!(power_d >= min_d_ && power_d <= max_d_)) return std::nullopt;
  if (!measured_d_.empty()) return measured_passing_s(power_d, eye);
  const double height = std::clamp(((power_d - min_d_) - (max_d_ - power_d)) / (max_d_ - min_d_), -1.0, 1.0);
  const double rising_s = std::acos(-height) / (2.0 * std::numbers::pi) * period_s_;
  return eye == Side::left ? rising_s : period_s_ - rising_s;
}

double PowerCurve::measured_passing_s(double power_d, Side eye) const {
  const std::size_t count = measured_d_.size();
  const auto sample_d = [&](std::size_t i) { return measured_d_[i % count]; };
  // The half as samples [from, to]; search for the last that has not passed the power yet.
  std::size_t from = eye == Side::left ? 0 : peak_;
  std::size_t to = eye == Side::left ? peak_ : count;
  while (to - from > 1) {
    const std::size_t middle = from + (to - from) / 2;
    const bool passed = eye == Side::left ? sample_d(middle) > power_d : sample_d(middle) < power_d;
    (passed ? to : from) = middle;
  }
  const double share = (power_d - sample_d(from)) / (sample_d(to) - sample_d(from));
  return (static_cast<double>(from) + share) / static_cast<double>(count) * period_s_;
}

std::vector<double> PowerCurve::samples_d(std::size_t count) const {
  if (!measured_d_.empty()) return resampled(measured_d_, count);
  std::vector<double> samples(count);
  for (std::size_t i = 0; i < count; ++i) {
    samples[i] = power_d(period_s_ * static_cast<double>(i) / static_cast<double>(count));
  }
  return samples;
}

std::vector<double> resampled(const std::vector<double>& samples, std::size_t count) {
  std::vector<double> result(count);
  for (std::size_t i = 0; i < count; ++i) {
    // In whole numbers, so that a given sample is met exactly.
    const std::size_t before = i * samples.size() / count;
    const std::size_t rest = i * samples.size() % count;
    const double share = static_cast<double>(rest) / static_cast<double>(count);
    result[i] = std::lerp(samples[before], samples[(before + 1) % samples.size()], share);
  }
  return result;
}

std::size_t lens_sample_count(const Sweep& sweep) {
  std::size_t common = 1;
  for (const Side eye : both_sides) {
    const Waveform& waveform = sweep.waveform[eye];
    const std::size_t own = waveform ? std::max<std::size_t>(1, waveform->power_d.size()) : 1;
    if (own > most_samples) return most_samples;
    common = std::lcm(common, own);
    if (common > most_samples) return most_samples;
  }
  return common == 1 ? fewest_samples : (fewest_samples + common - 1) / common * common;
}

}  // namespace focalstage
