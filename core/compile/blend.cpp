#include "core/compile/blend.h"

#include <glm/geometric.hpp>

#include "core/optics/pixel_density.h"

namespace focalstage {

Blend::Blend(const std::vector<BlendProjector>& projectors, const std::vector<ViewDrawable>& surfaces,
             const Kernel& kernel)
    : projectors_(projectors), surfaces_(surfaces), kernel_(kernel) {
  for (const BlendProjector& projector : projectors) reaches_.emplace_back(projector, surfaces, kernel);
}

SurfacePoint Blend::point_of(const TileMet& met, int i, const Rigid& world_from_projector) const {
  if (met.drawable[i] < 0) return {};
  const Drawable& drawable = *surfaces_[static_cast<std::size_t>(met.drawable[i])].drawable;
  const auto [a, b, c] = corners_m(drawable, met.triangle[i]);
  return {world_from_projector.point({met.x[i], met.y[i], met.z[i]}), glm::normalize(glm::cross(b - a, c - a)),
          met.drawable[i], met.triangle[i]};
}

/// What full white of a projector gives there, against what counts as 1.
double Blend::light(std::size_t projector, const SurfacePoint& point, bool thins) const {
  if (!thins) return 1.0;
  const BlendProjector& one = projectors_[projector];
  const Rigid projector_from_world = one.model.world_from_projector.inverse();
  return one.level *
         pixels_per_m2(one.model, projector_from_world.point(point.world_m),
                       projector_from_world.direction(point.normal)) /
         pixels_per_m2_on_axis(one.model, one.reference_m);
}

void Blend::share(std::size_t own, const TileMet& met, bool thins, Tile& out) const {
  SurfacePoint points[tile_samples];
  const Rigid& world_from_projector = projectors_[own].model.world_from_projector;
  for (int i = 0; i < tile_samples; ++i) points[i] = point_of(met, i, world_from_projector);
  double sum[tile_samples] = {};
  for (int i = 0; i < tile_samples; ++i) out.weight[i] = out.black[i] = 0.0;
  for (std::size_t j = 0; j < projectors_.size(); ++j) {
    double firm[tile_samples];
    reaches_[j].firmness(points, kernel_, firm);
    for (int i = 0; i < tile_samples; ++i) {
      // Its own ray ends here, whatever the rounding of the way there and back says of an edge.
      if (j == own && points[i].drawable >= 0 && !(firm[i] > 0.0)) firm[i] = least_firmness;
      sum[i] += firm[i];
      if (j == own) out.weight[i] = firm[i];
      if (firm[i] > 0.0 && projectors_[j].black_level > 0.0)
        out.black[i] += projectors_[j].black_level * light(j, points[i], thins);
    }
  }
  for (int i = 0; i < tile_samples; ++i) {
    if (sum[i] > 0.0) out.weight[i] /= sum[i];
  }
}

}  // namespace focalstage
