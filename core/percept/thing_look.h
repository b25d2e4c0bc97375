#pragma once

#include <vector>

#include "core/percept/things.h"
#include "core/retina/retina.h"

namespace focalstage {

/// How one thing looks to an eye.
struct ThingLook {
  std::size_t thing = 0;  ///< in the map's things
  int pixels = 0;         ///< of the picture in which it stands

  /// The contrast that is left of what a pinhole pupil would see: the root of the ratio of the pictures' squared
  /// luminance gradients over its pixels. 1: sharp; 0: nothing to see. Not a number where the pinhole sees no contrast.
  double sharpness = 0.0;
  double light = 0.0;               ///< mean over its pixels, 1 = full code of one whole exposure
  double candela_per_m2 = 0.0;      ///< mean luminance; 0 where the projector's brightness is not known
  double blur_radius_arcmin = 0.0;  ///< root mean square over its light of the pupil's disc p |a - a0| / 2
};

/// `seen` and `pinhole`: pictures of the same view but for the pupil.
std::vector<ThingLook> thing_looks(const ThingMap& things, const RetinaImage& seen, const RetinaImage& pinhole,
                                   const DrivenFocus& focus, const RetinaInput& input, const RetinaView& view);

}  // namespace focalstage
