#include "core/percept/lit_surfaces.h"

#include <algorithm>
#include <limits>
#include <stop_token>

#include <glm/common.hpp>

#include "core/base/luminance.h"
#include "core/retina/surface_paint.h"
#include "core/retina/surface_raster.h"

namespace focalstage {
namespace {

constexpr double nearest_lit_m = 1e-3;  // as in the compiler

/// The rectangle of the tangent plane around the projector's picture.
LookGrid grid_around(const ProjectorModel& projector, int side) {
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
  for (int i = 0; i <= side; ++i) {
    const double x = static_cast<double>(projector.width_px) * i / side;
    const double y = static_cast<double>(projector.height_px) * i / side;
    for (const glm::dvec2& pixel : {glm::dvec2(x, 0.0), glm::dvec2(x, projector.height_px), glm::dvec2(0.0, y),
                                    glm::dvec2(projector.width_px, y)}) {
      const glm::dvec2 tangent = tangent_of_pixel(projector, pixel);
      low = glm::min(low, tangent);
      high = glm::max(high, tangent);
    }
  }
  LookGrid grid;
  grid.width_px = grid.height_px = side;
  grid.step = glm::dvec2(high.x - low.x, low.y - high.y) / static_cast<double>(side);
  grid.first = glm::dvec2(low.x, high.y) + 0.5 * grid.step;
  return grid;
}

bool in_picture(const ProjectorModel& projector, const glm::dvec2& tangent) {
  const glm::dvec2 pixel = pixel_of_tangent(projector, tangent);
  return pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < projector.width_px && pixel.y < projector.height_px;
}

struct Sum {
  int count = 0;
  double albedo = 0.0;
  double density = 0.0;
};

}  // namespace

std::vector<LitSurface> lit_surfaces(const Stage& stage, const ProjectorModel& projector, int grid_side) {
  RetinaInput input;
  input.stage = &stage;
  input.projector = projector;
  input.falloff_reference_m = 1.0;
  const SurfaceMesh mesh = surface_mesh(stage.surfaces);
  const SurfacePaint paint(input, mesh);
  std::vector<std::size_t> owner;  // of each face
  for (std::size_t i = 0; i < stage.surfaces.size(); ++i) {
    for (const Drawable& drawable : stage.surfaces[i].drawables)
      owner.resize(owner.size() + drawable.mesh->triangles.size(), i);
  }
  const LookGrid grid = grid_around(projector, grid_side);
  const SurfaceRaster raster =
      raster_surfaces(mesh, projector.world_from_projector.inverse(), grid, nearest_lit_m, std::stop_token{});
  const double per_density = projector.focal_px.x * projector.focal_px.y;  // at the reference, a metre away
  std::vector<Sum> sums(stage.surfaces.size());
  int inside = 0;
  for (int row = 0; row < grid.height_px; ++row) {
    for (int column = 0; column < grid.width_px; ++column) {
      const glm::dvec2 look = grid.look(column, row);
      if (!in_picture(projector, look)) continue;
      ++inside;
      const std::uint32_t face = raster.at(column, row);
      if (face == SurfaceRaster::nothing) continue;
      const SeenFace& seen = raster.faces[face];
      glm::dvec3 weights(0.0);
      for (int i = 0; i < 3; ++i) weights[i] = SeenFace::at(seen.edge[i], look);
      const SpotReturn back = paint.at(face, weights / (weights.x + weights.y + weights.z),
                                       glm::dvec3(look, -1.0) / seen.inverse_depth(look));
      Sum& sum = sums[owner[face]];
      ++sum.count;
      sum.albedo += luminance<double>(back.albedo.r, back.albedo.g, back.albedo.b);
      sum.density += back.density;
    }
  }
  std::vector<LitSurface> lit;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const Sum& sum = sums[i];
    if (sum.count == 0) continue;
    lit.push_back({stage.surfaces[i].index, static_cast<double>(sum.count) / inside, sum.albedo / sum.count,
                   per_density * sum.density / sum.count});
  }
  return lit;
}

}  // namespace focalstage
