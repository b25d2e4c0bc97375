#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include <glm/mat3x3.hpp>

#include "core/optics/projector_model.h"
#include "core/retina/surface_raster.h"

namespace focalstage {

/// Which pixel of the projector lights a spot of a surface, and whether another surface keeps its light off.
class ProjectorLight {
 public:
  ProjectorLight(const SurfaceMesh& mesh, const ProjectorModel& projector, const std::stop_token& stop);

  /// The place in the image that lights the spot at `world_m` of face `face`; none outside the image or in shadow.
  std::optional<glm::dvec2> pixel(const glm::dvec3& world_m, std::uint32_t face) const;

 private:
  bool shadowed(const glm::dvec2& tangent, double depth_m, std::uint32_t face) const;
  void mark_smooth();

  ProjectorModel projector_;
  glm::dmat3 turn_;  ///< projector from world
  glm::dvec3 shift_m_;
  SurfaceRaster raster_;              ///< what is nearest to the projector
  std::vector<std::uint8_t> smooth_;  ///< [row][column]: no edge of a shadow within a pixel
};

}  // namespace focalstage
