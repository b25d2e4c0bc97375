#pragma once

#include <cstdint>
#include <vector>

#include "core/base/sides.h"

namespace focalstage {

/// A value and its standard uncertainty, both in the unit that the name says.
struct Estimate {
  double value = 0.0;
  double spread = 0.0;

  bool operator==(const Estimate&) const = default;
};

/// One harmonic of a lens, as core/scene/project.h has it; a lag is a negative phase, of more than a half
/// turn where the lens is that late.
struct MeasuredHarmonic {
  int harmonic = 0;
  Estimate gain_d_per_a;
  Estimate phase_deg;

  bool operator==(const MeasuredHarmonic&) const = default;
};

/// What was measured before one eye.
struct MeasuredEye {
  Estimate shutter_close_ms;
  Estimate shutter_open_ms;
  Estimate rest_power_d;  ///< of the lens without current: a project takes it for zero
  std::vector<MeasuredHarmonic> lens;

  bool operator==(const MeasuredEye&) const = default;
};

/// What a rig found out of itself (docs/self-test.md).
struct RigMeasurement {
  double frequency_hz = 60.0;  ///< whose harmonics the lenses list
  std::int64_t unix_s = 0;     ///< when: seconds since 1970, UTC
  Estimate latency_ms;         ///< of the projector, from trigger to the middle of the light's rise
  Estimate light_rise_ms;      ///< 10 to 90 % of that rise, the sensor's own in it
  PerEye<MeasuredEye> eye;

  bool operator==(const RigMeasurement&) const = default;
};

}  // namespace focalstage
