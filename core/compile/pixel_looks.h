#pragma once

#include <cstdint>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

#include "core/compile/surface_hits.h"

namespace focalstage {

/// The pixels of one tile as the eye sees the spots that they light, without a lens. NaN where it sees none.
struct LookTile {
  float x[tile_samples];  ///< straight look
  float y[tile_samples];
  float surface_m[tile_samples];  ///< own distance from the lens centre
  float stretch_m[tile_samples];  ///< the distance that stretches the look (d_c for planar breathing)
  glm::dmat2 look_per_pixel{0.0};
  glm::dmat2 pixel_per_look{0.0};
  glm::dvec2 look{0.0};  ///< of a seen pixel near the middle
  double surface_mean_m = 0.0;
  double stretch_mean_m = 0.0;
  bool usable = false;  ///< neighbours are seen, and the matrices mean something
};

/// The projector's raster in the tangent plane of one eye.
struct PixelLooks {
  TileGrid grid;
  std::vector<LookTile> tiles;
  /// [row][column]: pixels next to which the raster jumps in the eye's view, as at a step of the surfaces.
  std::vector<std::uint8_t> torn;
};

PixelLooks pixel_looks(const EyeHits& hits, const TileGrid& grid, int subsamples, double lens_to_pupil_m);

}  // namespace focalstage
