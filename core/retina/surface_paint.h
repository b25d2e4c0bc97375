#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "core/retina/retina.h"
#include "core/retina/surface_raster.h"

namespace focalstage {

/// What a spot sends back of the light on it.
struct SpotReturn {
  glm::vec3 albedo{1.0f};
  float density = 1.0f;  ///< of the projector's pixels there, against the reference
};

/// The colours of all surfaces of an input, and how the projector's light thins on them.
class SurfacePaint {
 public:
  /// The input's stage, and `mesh`, must outlive it.
  SurfacePaint(const RetinaInput& input, const SurfaceMesh& mesh);

  /// White all over, and lit alike: nobody need ask.
  bool plain() const { return plain_; }

  /// Of a spot of face `face`, which its corners share by `weights`; `projector_m`: in the projector's space.
  SpotReturn at(std::uint32_t face, const glm::dvec3& weights, const glm::dvec3& projector_m) const;

 private:
  double density(std::uint32_t face, const glm::dvec3& projector_m) const;

  const SurfaceMesh& mesh_;
  std::vector<Drawable> drawables_;
  std::vector<std::uint32_t> first_face_;  ///< of each
  ProjectorModel projector_;
  Rigid projector_from_world_;
  double reference_per_m2_ = 0.0;  ///< 0: light does not thin
  bool plain_ = true;
};

}  // namespace focalstage
