#include "core/schedule/lens_response.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace focalstage {
namespace {

using Complex = std::complex<double>;

constexpr double default_gain_d_per_a = 40.0;

/// cos and sin of every sample's phase, from which those of all harmonics are taken.
std::vector<Complex> circle(std::size_t count) {
  std::vector<Complex> turns(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    turns[i] = {std::cos(angle), std::sin(angle)};
  }
  return turns;
}

/// The complex amplitude of one harmonic: the samples hold Re(amplitude exp(2 pi i n t / T)).
Complex amplitude_of(const std::vector<double>& samples, const std::vector<Complex>& turns, std::size_t harmonic) {
  Complex sum = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) sum += samples[i] * std::conj(turns[i * harmonic % samples.size()]);
  return sum * ((harmonic == 0 ? 1.0 : 2.0) / static_cast<double>(samples.size()));
}

Complex factor_of(const LensHarmonic& harmonic) {
  // The static response has no phase.
  const double phase = harmonic.harmonic == 0 ? 0.0 : harmonic.phase_deg * std::numbers::pi / 180.0;
  return std::polar(1.0, phase) * harmonic.gain_d_per_a;
}

/// `samples` times `usual`, except for the listed harmonics: each times `factor(entry)`. What is not listed needs no
/// transform, so that no number of samples is better than another.
template <class Factor>
std::vector<double> filtered(const std::vector<double>& samples, const LensResponse& response, double usual,
                             Factor factor) {
  const std::vector<Complex> turns = circle(samples.size());
  std::vector<double> result(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) result[i] = samples[i] * usual;

  for (auto entry = response.begin(); entry != response.end(); ++entry) {
    const auto same = [&](const LensHarmonic& other) { return other.harmonic == entry->harmonic; };
    const bool repeated = std::any_of(response.begin(), entry, same);
    if (entry->harmonic < 0 || repeated) continue;
    const auto harmonic = static_cast<std::size_t>(entry->harmonic);
    if (harmonic > 0 && 2 * harmonic >= samples.size()) continue;
    const Complex change = amplitude_of(samples, turns, harmonic) * (factor(*entry) - usual);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Complex& turn = turns[i * harmonic % samples.size()];
      result[i] += change.real() * turn.real() - change.imag() * turn.imag();
    }
  }
  return result;
}

LensHarmonic entry_of(const LensResponse& response, int harmonic) {
  const auto found = std::ranges::find(response, harmonic, &LensHarmonic::harmonic);
  return found == response.end() ? LensHarmonic{harmonic, default_gain_d_per_a, 0.0, {}} : *found;
}

}  // namespace

std::vector<double> drive_for_power(const std::vector<double>& power_d, const LensResponse& response) {
  return filtered(power_d, response, 1.0 / default_gain_d_per_a, [](const LensHarmonic& entry) {
    const Complex factor = factor_of(entry);
    return factor == 0.0 ? Complex(0.0) : 1.0 / factor;
  });
}

std::vector<double> power_from_drive(const std::vector<double>& drive_a, const LensResponse& response) {
  return filtered(drive_a, response, default_gain_d_per_a, factor_of);
}

LensResponse halfway(const LensResponse& one, const LensResponse& other) {
  if (one == other) return one;
  LensResponse response;
  for (const LensResponse* listed : {&one, &other}) {
    for (const LensHarmonic& entry : *listed) {
      const int n = entry.harmonic;
      if (std::ranges::find(response, n, &LensHarmonic::harmonic) != response.end()) continue;
      const Complex middle = 0.5 * (factor_of(entry_of(one, n)) + factor_of(entry_of(other, n)));
      // A static response has a sign and no phase.
      if (n == 0) {
        response.push_back({n, middle.real(), 0.0, {}});
      } else {
        response.push_back({n, std::abs(middle), std::arg(middle) * 180.0 / std::numbers::pi, {}});
      }
    }
  }
  return response;
}

double strays(const LensHarmonic& one, const LensHarmonic& other) {
  const Complex sum = factor_of(one) + factor_of(other);
  return sum == 0.0 ? 1.0 : std::abs(factor_of(one) - factor_of(other)) / std::abs(sum);
}

}  // namespace focalstage
