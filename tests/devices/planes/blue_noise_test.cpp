#include "devices/planes/blue_noise.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace focalstage {
namespace {

TEST_CASE("every threshold equally often, and the same each time") {
  std::vector<int> counts(256, 0);
  for (const std::uint8_t threshold : blue_noise().thresholds) ++counts[threshold];
  CHECK(std::ranges::all_of(counts, [](int count) { return count == 16; }));
  CHECK(make_blue_noise(1).thresholds == blue_noise().thresholds);
  CHECK(make_blue_noise(2).thresholds != blue_noise().thresholds);
}

/// Power of a level's dots per frequency, mean over those with radius in [low, high) cycles per mask.
double power(int level, double low, double high) {
  const int size = static_cast<int>(BlueNoise::size);
  double sum = 0.0;
  int count = 0;
  for (int v = -size / 2; v < size / 2; ++v) {
    for (int u = -size / 2; u < size / 2; ++u) {
      const double radius = std::hypot(u, v);
      if (radius < low || radius >= high) continue;
      std::complex<double> total = 0.0;
      for (int i = 0; i < size * size; ++i) {
        if (blue_noise().thresholds[static_cast<std::size_t>(i)] >= level) continue;
        total += std::polar(1.0, 2.0 * std::numbers::pi * (u * (i % size) + v * (i / size)) / size);
      }
      sum += std::norm(total);
      ++count;
    }
  }
  return sum / count;
}

TEST_CASE("its noise is blue: next to none of it at low frequencies") {
  for (const int level : {16, 64, 128, 200}) {
    CAPTURE(level);
    const double dots = 16.0 * level;
    const double thrown_at_random = dots * (1.0 - dots / 4096.0);
    CHECK(power(level, 0.5, 6.0) < 0.1 * thrown_at_random);
  }
}

}  // namespace
}  // namespace focalstage
