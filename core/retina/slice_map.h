#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <stop_token>
#include <vector>

#include "core/retina/projector_light.h"
#include "core/retina/retina.h"
#include "core/retina/slice_eye.h"
#include "core/retina/surface_paint.h"
#include "core/retina/surface_raster.h"

namespace focalstage {

/// What one look meets through one slice: where in the projector's image its light comes from, and where its picture
/// lies.
struct SliceSpot {
  static constexpr float none = std::numeric_limits<float>::quiet_NaN();

  float x_px = none;  ///< dark: not a number
  float y_px = none;
  float vergence_d = none;  ///< at the pupil; not a number where no surface is seen
  float spread_px = 0.0f;   ///< radius of the disc over which the projector spreads a pixel there

  bool lit() const { return x_px == x_px; }
  bool seen() const { return vergence_d == vergence_d; }
};

/// Of the sixteenths of a pixel.
using EdgeReturns = std::array<SpotReturn, 16>;

/// A pixel in which the edge of a surface or of a shadow lies: what its sixteenths meet.
struct EdgePixel {
  static constexpr int across = 4;

  std::uint32_t column = 0;
  std::array<SliceSpot, across * across> spots;
};

/// That for a grid of looks. Knows nothing of images, focus or pupil.
struct SliceMap {
  LookGrid grid;
  double power_d = 0.0;
  std::vector<SliceSpot> spots;                        ///< [row][column], of the pixels' centres
  std::vector<std::vector<EdgePixel>> edges;           ///< [row], by column
  std::vector<SpotReturn> returns;                     ///< of the spots; none where surfaces are plain
  std::vector<std::vector<EdgeReturns>> edge_returns;  ///< of the edges
  float lowest_vergence_d = 0.0f;                      ///< of the lit spots
  float highest_vergence_d = 0.0f;
  float most_spread_px = 0.0f;
  glm::dvec2 seen_px{1.0};  ///< sides of the rectangle of the projector's image that a pixel of the grid sees
  bool any = false;         ///< lit spot

  const SliceSpot& spot(int column, int row) const {
    return spots[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width_px) +
                 static_cast<std::size_t>(column)];
  }
};

/// What looks through one power: the surfaces, the projector, and how far off the lens' centre a look may pass.
struct SliceScene {
  const SurfaceMesh& mesh;
  const ProjectorLight& light;
  const SurfacePaint* paint = nullptr;  ///< null: plain
  ProjectorFocus focus;
  double widest_off_axis_m = 0.0;
  int margin_px = 0;  ///< of the grid, around the picture: what is measured of looks is measured in the picture
};

/// Unfinished after a stop request.
SliceMap slice_map(const SliceScene& scene, const SliceEye& eye, const LookGrid& grid, const std::stop_token& stop);

}  // namespace focalstage
