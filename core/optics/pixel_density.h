#pragma once

#include <glm/vec3.hpp>

#include "core/optics/projector_model.h"

namespace focalstage {

// Every pixel of a projector carries the same light: what falls on a surface is in proportion to how densely its pixels
// lie there.

/// Pixels per square metre at a point (projector space) of a plane with that unit normal: J |n . r| / z^3, J the pixels
/// per unit of the tangent plane: fx fy, bent as the distortion bends. 0 behind the projector.
double pixels_per_m2(const ProjectorModel& projector, const glm::dvec3& point_m, const glm::dvec3& normal);

/// The same on the axis of a lens that does not bend, square to it.
double pixels_per_m2_on_axis(const ProjectorModel& projector, double distance_m);

}  // namespace focalstage
