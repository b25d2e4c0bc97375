#pragma once

#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/optics/image_plan.h"
#include "core/scene/project.h"
#include "core/schedule/drive_load.h"
#include "core/schedule/slots.h"

namespace focalstage {

/// What bounds a shaped sweep.
enum class ShapeLimit {
  response,     ///< the harmonics of the lens response that were measured; more would be driven blindly
  frequency,    ///< lens_limits.max_frequency_hz
  asked,        ///< the highest harmonic that the caller allows
  harmonics,    ///< most_shaped_harmonics
  current,      ///< lens_limits.max_current_a
  rms_current,  ///< lens_limits.max_rms_current_a
  range,        ///< the sweep's own extremes, within the lens's range
};

/// A limit that the shaped sweep stands at, or that kept it from being. In the unit of the limit: harmonics of the
/// sweep, amperes, dioptres.
struct ShapeBound {
  ShapeLimit limit = ShapeLimit::response;
  double needed = 0.0;  ///< what the sweep has, or would need if it cannot be had
  double allowed = 0.0;

  bool operator==(const ShapeBound&) const = default;
};

/// Beyond it a 0.5 ms exposure at 60 Hz gains nothing that a lens could be measured for.
inline constexpr int most_shaped_harmonics = 24;

struct ShapeOptions {
  std::optional<int> max_harmonic;
};

/// A sweep that dwells at its slices, beside the sine that it replaces.
struct SweepShape {
  bool better = false;  ///< less worst smear than the sine's, and no trouble that the sine has not; else no waveform
  PerEye<MeasuredWaveform> waveform;
  int highest_harmonic = 0;
  Timing sine;
  Timing shaped;  ///< empty where nothing better was found
  PerEye<DriveLoad> sine_load;
  PerEye<DriveLoad> shaped_load;
  std::vector<ShapeBound> bounds;  ///< those that bind
};

/// The waveform that makes the power stand as still as can be while slices are shown: band-limited, strictly monotonic
/// in each half, from its minimum; within the sweep's extremes, what of the lens response was measured, and
/// `glasses.lens_limits`. The left eye's rises slowly through the slices, the right eye's is its mirror image, as far
/// as the limits of both lenses allow. (D. Iwai, H. Izawa, K. Kashima, T. Ueda, K. Sato, Speeded-Up Focus Control of
/// Electrically Tunable Lens by Sparse Optimization, Scientific Reports 9:12365, 2019, optimise the drive of one change
/// of focus; here it is a whole period.)
///
/// Judged by `time_slots`. Bounded in time: three curves of at most 40 programs, 0.1 to 0.9 s in all as measured.
/// Faults: "shape.slices" (none, or two alike), "shape.projector", "shape.room" (the exposures do not fit between the
/// shutters), "shape.limits", "shape.sweep".
Result<SweepShape> shape_sweep(const Project& project, const std::vector<ImageSpec>& images,
                               const ShapeOptions& options = {});

/// The worst and the mean smear of the exposures; 0 where there are none.
double worst_smear_d(const Timing& timing);
double mean_smear_d(const Timing& timing);

/// The value of `sweep.waveform`, for an edit.
Value waveform_value(const PerEye<MeasuredWaveform>& waveform);

}  // namespace focalstage
