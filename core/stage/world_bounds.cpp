#include "core/stage/world_bounds.h"

namespace focalstage {

Bounds world_bounds(const std::vector<Drawable>& drawables) {
  Bounds bounds;
  for (const Drawable& drawable : drawables) {
    for (const glm::uvec3& triangle : drawable.mesh->triangles) {
      for (int corner = 0; corner < 3; ++corner) {
        const glm::dvec3& p = drawable.mesh->positions_m[triangle[corner]];
        bounds.include(glm::dvec3(drawable.world_from_mesh * glm::dvec4(p, 1.0)));
      }
    }
  }
  return bounds;
}

}  // namespace focalstage
