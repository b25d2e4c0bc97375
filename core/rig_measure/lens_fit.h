#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/rig_measure/lens_drives.h"
#include "core/rig_measure/light_trace.h"
#include "core/rig_measure/measurement.h"

namespace focalstage {

/// What was seen of one line through one drive.
struct LensLook {
  std::size_t drive = 0;
  std::size_t target = 0;
  std::vector<LightPoint> shares;  ///< FullLight::shares
};

struct LensFitTask {
  double period_s = 1.0 / 60.0;
  double step_s = 0.0;  ///< between the sensor's samples
  std::vector<KnownPower> targets;
  std::vector<DriveTones> drives;  ///< as lens_drives makes them
  LensResponse nominal;            ///< what the lens is thought to be: it only says which way a power is passed
  double delay_spread_s = 0.0;     ///< of the sensor's own delay
};

struct LensFit {
  Estimate rest_power_d;
  std::vector<MeasuredHarmonic> lens;  ///< from 0 on
  double residual_d = 0.0;             ///< root mean square over the crossings
  int crossings = 0;
};

/// The lens's response from the moments at which known powers are passed.
///
/// Light on the sensor's slit depends on how far the power is from the line's own, and on that alone; so where it
/// crosses one level, the power is the line's less or plus a width that is the same for all crossings of that line,
/// less on the way to it, plus on the way from it where the power rises. With power = rest + Re sum H[n] i[n] exp(i n w
/// t), every crossing is an equation that is linear in rest, H and the widths. They are solved together by weighted
/// least squares; each weight is the crossing's own spread times the speed of the power. The spreads hold residuals,
/// the known powers' own and the sensor's delay.
///
/// "measure.light" (no line was seen), "measure.passages" (too few, or they do not tell the harmonics apart),
/// "measure.lens" (no linear lens passes the powers named so).
Result<LensFit> fit_lens(const std::vector<LensLook>& looks, const LensFitTask& task, const std::string& where);

}  // namespace focalstage
