#pragma once

#include <cstdint>
#include <limits>
#include <stop_token>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/rigid.h"
#include "core/stage/stage.h"

namespace focalstage {

/// All surfaces of a stage as one mesh in world space; a triangle's index names its face everywhere in this room.
struct SurfaceMesh {
  std::vector<glm::dvec3> points_m;
  std::vector<glm::uvec3> faces;
};

/// Adds a drawable, its points brought into world space, behind all faces that are there.
void append(SurfaceMesh& all, const Drawable& drawable);

SurfaceMesh surface_mesh(const std::vector<StagedSurface>& surfaces);

/// Pixels in the tangent plane of a viewpoint.
struct LookGrid {
  int width_px = 0;
  int height_px = 0;
  glm::dvec2 first{0.0};       ///< the look of the first pixel's centre
  glm::dvec2 step{1.0, -1.0};  ///< to the next column (> 0) and row (!= 0)

  glm::dvec2 look(double column, double row) const { return first + glm::dvec2(column, row) * step; }
};

/// A face as its viewpoint sees it: four functions a x + b y + c of the look, kept as (a, b, c). The triple products of
/// the edges carry the sign of the side on which a look passes (none negative inside, exactly opposite for the two
/// faces of an edge, so that nothing slips between them) and hold for corners behind the viewpoint too; with the
/// corners' own triple product they give 1 / depth on the plane of the face.
struct SeenFace {
  glm::dvec3 edge[3];
  glm::dvec3 inverse_m{0.0};  ///< zero: edge-on, never seen

  static double at(const glm::dvec3& f, const glm::dvec2& look) { return f.x * look.x + f.y * look.y + f.z; }
  double inverse_depth(const glm::dvec2& look) const { return at(inverse_m, look); }
  bool covers(const glm::dvec2& look) const {
    return inverse_m != glm::dvec3(0.0) && at(edge[0], look) >= 0.0 && at(edge[1], look) >= 0.0 &&
           at(edge[2], look) >= 0.0;
  }
};

/// The columns and rows that a face can touch; all where a corner lies beside or behind the viewpoint.
struct PixelBox {
  int column_begin = 0;
  int column_end = 0;
  int row_begin = 0;
  int row_end = 0;

  bool empty() const { return column_begin >= column_end || row_begin >= row_end; }
  bool holds(int column, int row) const {
    return column >= column_begin && column < column_end && row >= row_begin && row < row_end;
  }
};

/// The nearest face in each pixel of a grid.
struct SurfaceRaster {
  static constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();

  LookGrid grid;
  std::vector<SeenFace> faces;         ///< as those of the mesh
  std::vector<PixelBox> boxes;         ///< of the faces
  std::vector<std::uint32_t> nearest;  ///< [row][column]

  std::uint32_t at(int column, int row) const {
    return nearest[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width_px) +
                   static_cast<std::size_t>(column)];
  }
};

/// Both sides of a face are seen; of faces at one depth the first; nothing nearer than `nearest_m`. Unfinished after a
/// stop request.
SurfaceRaster raster_surfaces(const SurfaceMesh& mesh, const Rigid& view_from_world, const LookGrid& grid,
                              double nearest_m, const std::stop_token& stop);

}  // namespace focalstage
