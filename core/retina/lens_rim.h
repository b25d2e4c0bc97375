#pragma once

#include <glm/vec2.hpp>

#include "core/retina/retina.h"

namespace focalstage {

/// How much of a pupil's disc the lens aperture leaves to a picture.
///
/// A ray that enters the pupil at height h from a picture at look u and vergence a passes the lens at d_e u +
/// h (1 - d_e a): the pupil's image on the lens is a disc about d_e u, as wide as the pupil times that factor. What of
/// it lies within the aperture comes through.
class LensRim {
 public:
  LensRim(const RetinaInput& input, const RetinaView& view);

  float open_share(const glm::dvec2& look, float vergence_at_pupil_d) const {
    const double off_axis_squared = (look.x * look.x + look.y * look.y) * squared_m_;
    return off_axis_squared <= whole_squared_m2_ ? 1.0f : rim_share(off_axis_squared, vergence_at_pupil_d);
  }

 private:
  float rim_share(double off_axis_squared_m2, double vergence_d) const;

  double lens_to_pupil_m_;
  double squared_m_;  ///< of that
  double lens_radius_m_;
  double pupil_radius_m_;
  double whole_squared_m2_;  ///< nearer to the axis than the root of this every pupil ray comes through
};

}  // namespace focalstage
