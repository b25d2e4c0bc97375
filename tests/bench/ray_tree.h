#pragma once

#include <vector>

#include <embree3/rtcore.h>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/rigid.h"
#include "core/stage/stage.h"

namespace focalstage::bench {

/// Drawables as one Embree scene of triangles, in the space of who looks.
class RayTree {
 public:
  RayTree(RTCDevice device, const std::vector<const Drawable*>& drawables, const Rigid& view_from_world);
  ~RayTree();
  RayTree(const RayTree&) = delete;
  RayTree& operator=(const RayTree&) = delete;

  struct Hit {
    const Drawable* drawable = nullptr;
    glm::dvec3 point_m{0.0};
    glm::dvec3 normal{0.0};
    glm::dvec2 uv{0.0};
  };

  bool nearest(const glm::dvec2& look, float nearest_m, Hit& hit) const;

  /// Whether something lies before `depth_m` along the look.
  bool hidden(const glm::dvec2& look, float nearest_m, float depth_m) const;

 private:
  void add(RTCDevice device, const Drawable& drawable, const glm::dmat4& view_from_mesh);

  std::vector<const Drawable*> drawables_;
  std::vector<std::vector<glm::dvec3>> points_;  ///< of each drawable, in view space
  RTCScene scene_;
};

}  // namespace focalstage::bench
