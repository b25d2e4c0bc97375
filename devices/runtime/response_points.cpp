#include "devices/runtime/response_points.h"

#include <algorithm>
#include <cmath>

#include "core/schedule/sweep_shape.h"

namespace focalstage {

namespace {

/// Straight between the measured points; `frequency_hz` lies within them.
LensHarmonic at(const std::vector<ResponsePoint>& points, int harmonic, double frequency_hz) {
  const auto above = std::ranges::lower_bound(points, frequency_hz, {}, &ResponsePoint::frequency_hz);
  if (above->frequency_hz == frequency_hz) return {harmonic, above->gain_d_per_a, above->phase_deg, {}};
  const auto below = above - 1;
  const double share = (frequency_hz - below->frequency_hz) / (above->frequency_hz - below->frequency_hz);
  return {harmonic,
          std::lerp(below->gain_d_per_a, above->gain_d_per_a, share),
          std::lerp(below->phase_deg, above->phase_deg, share),
          {}};
}

}  // namespace

LensResponse response_at(const std::vector<ResponsePoint>& points, double frequency_hz) {
  LensResponse response;
  for (int n = 0; n <= most_shaped_harmonics; ++n) {
    if (n * frequency_hz > points.back().frequency_hz) break;
    response.push_back(at(points, n, n * frequency_hz));
  }
  return response;
}

}  // namespace focalstage
