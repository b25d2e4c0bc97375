#include "core/schedule/wanted_power.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/number_words.h"
#include "core/schedule/drive_load.h"
#include "core/schedule/lens_response.h"
#include "core/schedule/shape_rules.h"
#include "core/schedule/waveform.h"

namespace focalstage {
namespace {

constexpr std::size_t fewest_samples = 8;
constexpr std::size_t most_samples = 65536;

Fault fault(const std::string& code, const std::string& message, const std::string& remedy) {
  return {"wanted." + code, "the wanted power", message, remedy};
}

Status check_curve(const std::vector<double>& power_d) {
  if (power_d.size() < fewest_samples || power_d.size() > most_samples) {
    return fault("curve", "has " + std::to_string(power_d.size()) + " samples",
                 "give 8 to 65536 uniform samples of one period");
  }
  Sweep sweep;
  sweep.waveform.left = MeasuredWaveform{power_d, {}, {}};
  const Result<PowerCurve> curve = PowerCurve::make(sweep, Side::left);
  if (curve) return {};
  return fault("curve", curve.fault().message, "let it rise once and fall once in a period, without standing still");
}

/// What of the power the lens cannot be driven to: all harmonics but those up to the last measured one.
std::vector<double> unmeasured(const std::vector<double>& power_d, const LensResponse& response) {
  LensResponse measured;
  const int highest = std::max(1, measured_harmonics(response));
  for (int n = 0; n <= highest; ++n) measured.push_back({n, 0.0, 0.0, {}});
  std::vector<double> rest = power_from_drive(power_d, measured);  // theirs come to nothing, the others 40 fold
  for (double& power : rest) power /= LensHarmonic{}.gain_d_per_a;
  return rest;
}

double largest(const std::vector<double>& numbers) {
  double most = 0.0;
  for (const double number : numbers) most = std::max(most, std::abs(number));
  return most;
}

Status check_measured(const std::vector<double>& power_d, const LensResponse& response) {
  const double lost_d = largest(unmeasured(power_d, response));
  if (lost_d <= most_unmeasured_d) return {};
  return fault("unmeasured",
               short_text(lost_d, 4) + " D of it lie beyond harmonic " +
                   std::to_string(std::max(1, measured_harmonics(response))) + ", where the lens was not measured",
               "smooth it, let its last sample lead to its first, or adopt-rig a response that goes further");
}

}  // namespace

Result<MeasuredWaveform> wanted_waveform(std::vector<double> power_d, const Glasses& glasses, Side eye) {
  const auto lowest = std::min_element(power_d.begin(), power_d.end());
  std::rotate(power_d.begin(), lowest, power_d.end());
  if (Status checked = check_curve(power_d); !checked) return checked.fault();
  const double highest_d = *std::max_element(power_d.begin(), power_d.end());
  if (power_d.front() < glasses.lens_range_d[0] || highest_d > glasses.lens_range_d[1]) {
    return fault("range",
                 "from " + short_text(power_d.front(), 4) + " to " + short_text(highest_d, 4) + " D is beyond the lens",
                 "keep it from " + short_text(glasses.lens_range_d[0], 4) + " to " +
                     short_text(glasses.lens_range_d[1], 4) + " D");
  }
  const LensResponse& response = glasses.lens_response[eye];
  if (Status measured = check_measured(power_d, response); !measured) return measured.fault();
  MeasuredWaveform waveform{power_d, drive_for_power(power_d, response), {}};
  const LensLimits limits = glasses.lens_limits.value_or(LensLimits{});
  const DriveLoad load = load_of(waveform.drive_a);
  if (load.peak_a <= limits.max_current_a && load.rms_a <= limits.max_rms_current_a) return waveform;
  return fault("current",
               "its drive takes " + short_text(load.peak_a, 4) + " A at the peak and " + short_text(load.rms_a, 4) +
                   " A in the root mean square; the lens may get " + short_text(limits.max_current_a, 4) + " and " +
                   short_text(limits.max_rms_current_a, 4) + " A",
               "narrow or smooth it");
}

}  // namespace focalstage
