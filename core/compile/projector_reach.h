#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/compile/frame.h"
#include "core/compile/kernel.h"
#include "core/compile/surface_hits.h"
#include "core/compile/view_triangles.h"

namespace focalstage {

/// A point of a surface, in world space.
struct SurfacePoint {
  glm::dvec3 world_m{0.0};
  glm::dvec3 normal{0.0};  ///< unit, of its face; either side
  std::int32_t drawable = -1;
  std::uint32_t triangle = 0;
};

/// Corners of a triangle of a drawable, in world space.
std::array<glm::dvec3, 3> corners_m(const Drawable& drawable, std::uint32_t triangle);

/// What one of several projectors lights, and how firmly (docs/blending.md).
class ProjectorReach {
 public:
  /// `surfaces` must outlive it.
  ProjectorReach(const BlendProjector& projector, const std::vector<ViewDrawable>& surfaces, const Kernel& kernel);

  /// Of each of the `tile_samples` points (those with a drawable): 0 where it gets none of this projector's light, by
  /// the edge of its picture or by shadow; else above 0 and up to 1, running out smoothly over the margin towards
  /// either, and where light only grazes the surface.
  void firmness(const SurfacePoint* points, const Kernel& kernel, double* out) const;

 private:
  /// How the picture's pixels hang together: neighbours on one body, and those beside which a nearer one ends.
  struct Rim {
    std::int32_t column = -1;  ///< of the nearest pixel of the same body that lies beside a nearer one; -1: none
    std::int32_t row = -1;
  };

  bool goes_on(const TileMet& a, int i, const TileMet& b, int j, bool& a_is_nearer) const;
  double plane_depth_m(const TileMet& met, int i, const glm::dvec2& tangent) const;
  double pixel_m(double depth_m) const;
  void find_rims();
  void spread_rims();
  double edge_share(const glm::dvec2& place) const;
  double shadow_share(const glm::dvec2& pixel, const glm::dvec2& tangent, double depth_m,
                      const SurfacePoint& point) const;

  BlendProjector projector_;
  Rigid projector_from_world_;
  std::vector<ViewDrawable> surfaces_;
  TileGrid grid_;
  ProjectorSight sight_;
  ProjectorHits hits_;            ///< of the middle of each pixel
  std::vector<std::uint8_t> go_;  ///< [row][column]: 1, the body goes on to the pixel on the right; 2, below
  std::vector<Rim> rims_;         ///< [row][column]
};

/// What a lit point has at least, so that one which a single projector reaches has all of its weight.
inline constexpr double least_firmness = 1e-9;

/// 3 t^2 - 2 t^3 of a share of the way, 0 before it and 1 beyond.
double smooth_step(double share);

}  // namespace focalstage
