#include "core/rig_measure/lens_drives.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/number_words.h"

namespace focalstage {

namespace {

using Complex = std::complex<double>;

constexpr double least_apart_d = 0.5;
// In half distances of the outermost known powers: how far the sweep goes, and how far it is shifted. All are passed at
// more than half the sweep's greatest speed, also where a lens is a fifth weaker than thought.
constexpr double sweep_reach = 1.8;
constexpr double offset_reach = 0.35;
// A further harmonic changes the speed at which the powers are passed by less than half.
constexpr double tone_reach = 0.65;

}  // namespace

double DriveTones::at(double time_s, double period_s) const {
  double current_a = 0.0;
  for (std::size_t n = 0; n < amplitude.size(); ++n) {
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(n) * time_s / period_s;
    current_a += (amplitude[n] * std::polar(1.0, turn)).real();
  }
  return current_a;
}

std::vector<double> DriveTones::samples(std::size_t count) const {
  std::vector<double> current_a(count);
  for (std::size_t i = 0; i < count; ++i) current_a[i] = at(static_cast<double>(i), static_cast<double>(count));
  return current_a;
}

Complex factor_of(const LensResponse& response, int harmonic) {
  const auto entry = std::ranges::find(response, harmonic, &LensHarmonic::harmonic);
  if (entry == response.end()) return 40.0;
  const double turn = harmonic == 0 ? 0.0 : entry->phase_deg * std::numbers::pi / 180.0;
  return std::polar(1.0, turn) * entry->gain_d_per_a;
}

Result<std::vector<DriveTones>> lens_drives(const std::vector<KnownPower>& targets, const LensResponse& nominal,
                                            int harmonics, double most_a) {
  const auto [least, most] = std::ranges::minmax_element(targets, {}, &KnownPower::power_d);
  if (targets.size() < 2 || most->power_d - least->power_d < least_apart_d) {
    return Fault{"measure.targets", "light sensor", "two known powers, 0.5 D apart or more, are needed",
                 "put a second line at another distance, and list it in devices.light_sensor.targets"};
  }
  const double half_d = 0.5 * (most->power_d - least->power_d);
  const double middle_d = 0.5 * (most->power_d + least->power_d);
  const auto tones = [&](double offset) {
    DriveTones drive;
    drive.amplitude.assign(static_cast<std::size_t>(harmonics) + 1, 0.0);
    drive.amplitude[0] = (middle_d + offset * half_d) / factor_of(nominal, 0);
    // From its lowest power on, as every sweep.
    drive.amplitude[1] = -sweep_reach * half_d / factor_of(nominal, 1);
    return drive;
  };
  std::vector<DriveTones> drives;
  for (const double offset : {-offset_reach, 0.0, offset_reach}) drives.push_back(tones(offset));
  for (int n = 2; n <= harmonics; ++n) {
    for (const Complex turn : {Complex(1.0, 0.0), Complex(0.0, 1.0)}) {
      drives.push_back(tones(0.0));
      const double reach_d = tone_reach * half_d / n;
      drives.back().amplitude[static_cast<std::size_t>(n)] = reach_d * turn / factor_of(nominal, n);
    }
  }
  double worst_a = 0.0;
  for (const DriveTones& drive : drives) {
    for (const double current_a : drive.samples(1024)) worst_a = std::max(worst_a, std::abs(current_a));
  }
  if (worst_a < most_a) return drives;
  return Fault{
      "measure.drive", "lens drive",
      "to sweep over all known powers a lens needs " + short_text(worst_a, 3) + " A, and this rig allows " +
          short_text(most_a, 3) + " A",
      "put the lines at distances that need less power, or raise limits.lens_current_max_a if the lens bears it"};
}

}  // namespace focalstage
