#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "core/base/result.h"
#include "core/base/sides.h"
#include "core/scene/project.h"

namespace focalstage {

/// A power of the lens at which a line is sharp on the sensor, and how well that is known.
struct KnownPower {
  double power_d = 0.0;
  double spread_d = 0.0;
};

/// One period of current: the real part of the sum of amplitude[n] exp(2 pi i n t / T), in amperes.
struct DriveTones {
  std::vector<std::complex<double>> amplitude;

  double at(double time_s, double period_s) const;
  std::vector<double> samples(std::size_t count) const;
};

/// The drives by which a lens's harmonics 0 to `harmonics` are found: a sweep over all known powers, at three offsets;
/// then for each further harmonic the sweep with that harmonic added, at two phases a quarter turn apart. `nominal`:
/// the lens as it is thought to be; a fifth off is no harm.
///
/// "measure.targets": fewer than two known powers, or nearer than 0.5 D. "measure.drive": more than `most_a` would be
/// needed.
Result<std::vector<DriveTones>> lens_drives(const std::vector<KnownPower>& targets, const LensResponse& nominal,
                                            int harmonics, double most_a);

/// The power over the current of one harmonic; what a response does not list has 40 D/A and no lag.
std::complex<double> factor_of(const LensResponse& response, int harmonic);

}  // namespace focalstage
