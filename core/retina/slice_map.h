#pragma once

#include <limits>
#include <stop_token>
#include <vector>

#include "core/retina/projector_light.h"
#include "core/retina/slice_eye.h"
#include "core/retina/surface_raster.h"

namespace focalstage {

/// What one look meets through one slice: where in the projector's image its light comes from, and where its picture
/// lies.
struct SliceSpot {
  static constexpr float none = std::numeric_limits<float>::quiet_NaN();

  float x_px = none;  ///< dark: not a number
  float y_px = none;
  float vergence_d = none;  ///< at the pupil; not a number where no surface is seen

  bool lit() const { return x_px == x_px; }
  bool seen() const { return vergence_d == vergence_d; }
};

/// That for a grid of looks. Knows nothing of images, focus or pupil.
struct SliceMap {
  LookGrid grid;
  double power_d = 0.0;
  std::vector<SliceSpot> spots;    ///< [row][column]
  float lowest_vergence_d = 0.0f;  ///< of the lit spots
  float highest_vergence_d = 0.0f;
  double footprint_px = 0.0;  ///< side of the square of the projector's image that a pixel of the grid sees
  bool any = false;           ///< lit spot
};

/// `lens_radius_m`: looks that miss the lens are dark. Unfinished after a stop request.
SliceMap slice_map(const SurfaceMesh& mesh, const ProjectorLight& light, const SliceEye& eye, double lens_radius_m,
                   const LookGrid& grid, const std::stop_token& stop);

}  // namespace focalstage
