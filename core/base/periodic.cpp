#include "core/base/periodic.h"

#include <cmath>
#include <cstddef>

namespace focalstage {

double periodic_at(std::span<const double> samples, double turns) {
  if (samples.empty()) return 0.0;
  const double place = (turns - std::floor(turns)) * static_cast<double>(samples.size());
  const double whole = std::floor(place);
  const std::size_t before = static_cast<std::size_t>(whole) % samples.size();
  return std::lerp(samples[before], samples[(before + 1) % samples.size()], place - whole);
}

double wrapped_s(double time_s, double period_s) {
  const double rest_s = std::fmod(time_s, period_s);
  const double positive_s = rest_s < 0.0 ? rest_s + period_s : rest_s;
  return positive_s < period_s ? positive_s : 0.0;  // a rest just below zero rounds up to the period
}

}  // namespace focalstage
