#pragma once

#include <vector>

#include <glm/mat3x3.hpp>

#include "core/retina/edge_faces.h"
#include "core/retina/slice_map.h"

namespace focalstage {

inline constexpr double nearest_seen_m = 1e-3;  ///< nothing nearer to the lens centre is seen, as in the compiler

/// Reads the nearest faces that one power shows into spots: of each pixel's centre, and of its parts where an edge runs
/// through it.
class Spotter {
 public:
  Spotter(const SurfaceRaster& raster, const SliceScene& scene, const SliceEye& eye);

  /// `returns`: null where nobody asks.
  void row(const LookGrid& grid, int row, SliceSpot* spots, SpotReturn* returns) const;

  /// The pixels whose neighbours see something else: no surface, no light, another depth. `spots`: of the whole grid.
  std::vector<EdgeFaces::Pixel> edges(const std::vector<SliceSpot>& spots) const;

  /// What the parts of such a pixel meet.
  EdgePixel parts_of(const LookGrid& grid, EdgeFaces::Pixel pixel, const EdgeFaces& faces, SpotReturn* returns) const;

 private:
  bool through_lens(const glm::dvec2& look) const;
  SliceSpot spot(const glm::dvec2& look, std::uint32_t face, SpotReturn* back) const;
  SpotReturn returned(const glm::dvec2& narrowed, std::uint32_t face, const glm::dvec3& projector_m) const;
  bool at_edge(int row, int column, const std::vector<SliceSpot>& spots) const;

  const SurfaceRaster& raster_;
  const SliceScene& scene_;
  const SliceEye& eye_;
  double px_per_d_ = 0.0;  ///< radius of the projector's blur
  double most_look_squared_ = 0.0;
  double most_inverse_m_ = 0.0;
  glm::dmat3 turn_;
  glm::dvec3 shift_m_;
};

}  // namespace focalstage
