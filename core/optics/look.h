#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace focalstage {

// A *look* is a direction from the pupil, written as its position in the eye's tangent plane: eye-space x and y divided
// by the distance along the gaze. All slices of one eye look from the same point; a slice is only another set of looks.

/// Where a point is seen through no lens: the look straight at it. `eye_point_m` in eye space, in front (z < 0).
glm::dvec2 straight_look(const glm::dvec3& eye_point_m);

/// Factor by which a lens of `power_d` stretches the straight look at a surface `surface_m` from the lens centre: the
/// inverse of the paper's resize 1 - v d_e d_p / (d_p + d_e) (Eq. 5), exact for every point of any surface because the
/// direction in which it appears is w = (P - C) + (1 - v d_p)(C - E). Positive for any power below 1/d_e.
double look_stretch(double power_d, double surface_m, double lens_to_pupil_m);

/// Axial distance from the lens centre at which the look meets the plane through `eye_point_m` with `eye_normal`.
/// The point's own distance where the look runs along the plane or meets it behind the lens.
double plane_distance_m(const glm::dvec2& look, const glm::dvec3& eye_point_m, const glm::dvec3& eye_normal,
                        double lens_to_pupil_m);

}  // namespace focalstage
