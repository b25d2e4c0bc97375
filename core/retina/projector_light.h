#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/optics/projector_model.h"
#include "core/retina/surface_raster.h"

namespace focalstage {

/// Which pixel of the projector lights a spot of a surface, and whether another surface keeps its light off.
class ProjectorLight {
 public:
  ProjectorLight(const SurfaceMesh& mesh, const ProjectorModel& projector, const std::stop_token& stop);

  const Rigid& projector_from_world() const { return projector_from_world_; }

  /// The place in the image that lights a spot of face `face`; none outside the image or in shadow. `spot`: in the
  /// projector's space, divided by its distance from whoever looks, whose inverse is `scale`.
  std::optional<glm::dvec2> pixel(const glm::dvec3& spot, double scale, std::uint32_t face) const;

 private:
  bool shadowed(const glm::dvec2& tangent, const glm::dvec2& place, double inverse_m, std::uint32_t face) const;
  bool shadowed_by_one(const glm::dvec2& tangent, int column, int row, double inverse_m, std::uint32_t face) const;
  bool goes_on(std::uint32_t a, std::uint32_t b, const glm::dvec2& one, const glm::dvec2& other) const;
  void mark_edges();
  void mark_blocks();

  static constexpr int block_px = 8;

  ProjectorModel projector_;
  Rigid projector_from_world_;
  SurfaceRaster raster_;      ///< what is nearest to the projector
  glm::dvec2 per_step_{1.0};  ///< of its grid
  /// [row][column]: 1 / depth of the nearest face; negative where the edge of a shadow lies within a pixel.
  std::vector<float> nearest_inverse_m_;
  int block_columns_ = 0;
  std::vector<std::uint32_t>
      sole_;  ///< [row][column] of blocks: the face that alone fills a block and its neighbourhood
};

}  // namespace focalstage
