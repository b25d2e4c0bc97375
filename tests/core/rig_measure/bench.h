#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "core/rig_measure/light_trace.h"

// A laboratory bench on paper: light, a lens and a slit from first principles, and a sensor that spoils it. Nothing of
// the room's own arithmetic.

namespace focalstage::bench {

struct Sensor {
  int bits = 10;
  double step_s = 26e-6;
  double noise = 0.002;   ///< of the range
  double ambient = 0.05;  ///< of the range
  double hum = 0.01;      ///< amplitude, of the range
  double hum_hz = 100.0;
  double clock_off = 0.0;  ///< of the times it tells, after they were scaled to the period
  std::uint32_t seed = 1;
};

/// A disc of light (a line's defocused point) on a slit: the share that passes. The disc is `off_d` dioptres out of
/// focus; the slit is as wide as the disc is at `slit_d`.
inline double through_slit(double off_d, double slit_d) {
  const double ratio = std::abs(off_d) < 1e-12 ? 2.0 : slit_d / std::abs(off_d);
  if (ratio >= 1.0) return 1.0;
  return 2.0 / std::numbers::pi * (std::asin(ratio) + ratio * std::sqrt(1.0 - ratio * ratio));
}

/// `traces` goes of `samples` samples from `first_s` on, each at a sweep of its own and begun a little later in the
/// step; `light` of the time since the edge.
inline LightTraces record(const Sensor& sensor, const std::function<double(double)>& light, double first_s,
                          std::size_t samples, int traces = 24, double period_s = 1.0 / 60.0) {
  std::mt19937 random(sensor.seed);
  std::normal_distribution<double> noise(0.0, sensor.noise);
  const double codes = std::exp2(sensor.bits) - 1.0;
  LightTraces found;
  for (int k = 0; k < traces; ++k) {
    LightTrace trace;
    // Traces are some sweeps apart, as a host asks for them.
    const double edge_s = (5.0 * k + 1.0) * period_s;
    const double begun_s = first_s + sensor.step_s * k / traces;
    trace.first_s = begun_s * (1.0 + sensor.clock_off);
    trace.step_s = sensor.step_s * (1.0 + sensor.clock_off);
    for (std::size_t i = 0; i < samples; ++i) {
      const double at_s = begun_s + static_cast<double>(i) * sensor.step_s;
      const double hum = sensor.hum * std::sin(2.0 * std::numbers::pi * sensor.hum_hz * (edge_s + at_s));
      const double value = light(at_s) + sensor.ambient + hum + noise(random);
      trace.light.push_back(std::round(std::clamp(value, 0.0, 1.0) * codes) / codes);
    }
    found.push_back(std::move(trace));
  }
  return found;
}

/// Exposures one after the other, with a dark gap after each, from `from_s` to `to_s`.
inline double exposures(double time_s, double from_s, double to_s, double exposure_s, double gap_s) {
  if (time_s < from_s || time_s > to_s) return 0.0;
  return std::fmod(time_s - from_s, exposure_s + gap_s) < exposure_s ? 1.0 : 0.0;
}

}  // namespace focalstage::bench
