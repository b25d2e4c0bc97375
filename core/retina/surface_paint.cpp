#include "core/retina/surface_paint.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "core/optics/pixel_density.h"
#include "core/stage/albedo.h"

namespace focalstage {

SurfacePaint::SurfacePaint(const RetinaInput& input, const SurfaceMesh& mesh)
    : mesh_(mesh), projector_(input.projector), projector_from_world_(input.projector.world_from_projector.inverse()) {
  if (input.falloff_reference_m) {
    reference_per_m2_ = pixels_per_m2_on_axis(projector_, *input.falloff_reference_m);
    plain_ = false;
  }
  std::uint32_t faces = 0;
  for (const StagedSurface& surface : input.stage->surfaces) {
    for (const Drawable& drawable : surface.drawables) {
      first_face_.push_back(faces);
      faces += static_cast<std::uint32_t>(drawable.mesh->triangles.size());
      plain_ = plain_ && even_albedo(drawable) == glm::dvec3(1.0);
      drawables_.push_back(drawable);
    }
  }
}

double SurfacePaint::density(std::uint32_t face, const glm::dvec3& projector_m) const {
  if (!(reference_per_m2_ > 0.0)) return 1.0;
  const glm::uvec3& corners = mesh_.faces[face];
  const glm::dvec3& a = mesh_.points_m[corners.x];
  const glm::dvec3 normal = glm::normalize(glm::cross(mesh_.points_m[corners.y] - a, mesh_.points_m[corners.z] - a));
  return pixels_per_m2(projector_, projector_m, projector_from_world_.direction(normal)) / reference_per_m2_;
}

SpotReturn SurfacePaint::at(std::uint32_t face, const glm::dvec3& weights, const glm::dvec3& projector_m) const {
  const auto after = std::upper_bound(first_face_.begin(), first_face_.end(), face);
  const auto own = static_cast<std::size_t>(after - first_face_.begin() - 1);
  const glm::dvec3 albedo = albedo_at(drawables_[own], face - first_face_[own], weights);
  return {glm::vec3(albedo), static_cast<float>(density(face, projector_m))};
}

}  // namespace focalstage
