#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/mesh/mesh.h"

namespace focalstage {

// The primitives of the project file (design section 4). All carry normals and UVs; sizes must be positive and finite.

/// In local XY around the origin, facing +Z; u along +X and v along +Y from the lower left corner.
Mesh make_plane(const glm::dvec2& size_m);

/// Around the origin; each face carries the whole unit square of UV, upright as seen from outside.
Mesh make_box(const glm::dvec3& size_m);

/// Around the origin, poles on Y; u is the longitude, eastwards, 0.5 at +Z, and v the latitude, from the south pole.
Mesh make_sphere(double radius_m);

/// A fold along local Y through the origin with wings of `size_m` to both sides, symmetric about and opening towards +Z
/// at `angle_deg` (0..360, 180 is flat). u runs across both wings from the left one's outer edge.
Mesh make_corner(const glm::dvec2& size_m, double angle_deg);

/// x < 0 at z = 0, x > 0 at z = -depth_m, joined by a wall; `size_m` is the whole. u runs across all three, unfolded.
/// A negative depth puts the right half in front.
Mesh make_step(const glm::dvec2& size_m, double depth_m);

/// Martin Newell's teapot, 1 m high, standing on y = 0, its spout towards +Z. Open where the original is: between rim
/// and lid, and where handle and spout enter the body.
Mesh make_teapot();

/// A sitting rabbit, 1 m high, standing on y = 0, looking towards +Z. Closed and smooth. Its UVs are laid on
/// along Z, without a seam: u = x + 0.5, v = y.
Mesh make_rabbit();

}  // namespace focalstage
