#include "core/compile/coverage.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/compile/cells.h"
#include "core/compile/kernel.h"
#include "core/compile/surface_hits.h"
#include "core/compile/view_triangles.h"
#include "core/optics/eye.h"

namespace focalstage {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Box everything{-infinity, -infinity, infinity, infinity};
constexpr double shadow_tolerance = 1e-3;  ///< of the depth; a shadow's rim may count to either side

/// Triangles of one view in cells, to be asked for the nearest along looks.
struct Sight {
  ViewTriangles view;
  Cells cells;
  Box bounds{infinity, infinity, -infinity, -infinity};

  Sight(const std::vector<ViewDrawable>& drawables, const Rigid& view_from_world, double nearest_m, int cells_across) {
    set_up(view, drawables, view_from_world, nearest_m, everything);
    for (const ViewTriangles::Run& run : view.runs) {
      for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
        const Box& box = view.bounds[i].box;
        bounds = {std::min(bounds.min_x, box.min_x), std::min(bounds.min_y, box.min_y),
                  std::max(bounds.max_x, box.max_x), std::max(bounds.max_y, box.max_y)};
      }
    }
    // What reaches behind the viewer reaches to infinity here; nobody looks that far aside.
    constexpr float widest = 4.0f;
    bounds = {std::max(bounds.min_x, -widest), std::max(bounds.min_y, -widest), std::min(bounds.max_x, widest),
              std::min(bounds.max_y, widest)};
    if (!empty()) sort_into_cells(cells, view, bounds, cells_across, cells_across, {}, 0.0);
  }

  bool empty() const { return !(bounds.min_x <= bounds.max_x && bounds.min_y <= bounds.max_y); }
};

/// 64 looks and what they met: depth along the axis (NaN: nothing) and the drawable.
struct Looks {
  double x[tile_samples];
  double y[tile_samples];
};
struct Met {
  double depth_m[tile_samples];
  std::uint32_t drawable[tile_samples];
};

Met nearest(const Sight& sight, const Looks& looks) {
  Met met;
  std::fill_n(met.depth_m, tile_samples, nan);
  if (sight.empty()) return met;
  const LocalLooks local = local_looks(looks.x, looks.y, best_kernel());
  if (!local.any) return met;
  TileNearest found;
  best_kernel().cover(kernel_view(sight.view, sight.cells), local.looks, local.origin_x, local.origin_y, found);
  for (int i = 0; i < tile_samples; ++i) {
    if (found.triangle[i] < 0) continue;
    const ViewTriangle& triangle = sight.view.triangles[static_cast<std::size_t>(found.triangle[i])];
    met.depth_m[i] = 1.0 / triangle.inverse_depth(looks.x[i], looks.y[i]);
    met.drawable[i] = triangle.drawable;
  }
  return met;
}

template <class Thing>
std::vector<ViewDrawable> drawables_of(const std::vector<Thing>& things) {
  std::vector<ViewDrawable> all;
  for (std::size_t i = 0; i < things.size(); ++i) {
    for (const Drawable& drawable : things[i].drawables)
      all.push_back({&drawable, false, static_cast<std::uint32_t>(i)});
  }
  return all;
}

/// One eye at work.
struct Survey {
  const Sight& objects;
  const Sight& surfaces;
  const Sight& from_projector;
  const ProjectorModel& projector;
  Rigid projector_from_eye;
  double lens_to_pupil_m;
  double lens_aperture_m;
  const std::vector<ViewDrawable>& object_drawables;
};

/// Looks of one tile of the grid over the objects' bounds.
Looks grid_looks(const Box& bounds, int grid, int tile_column, int tile_row) {
  Looks looks;
  for (int i = 0; i < tile_samples; ++i) {
    const double column = tile_column * tile_side + i % tile_side + 0.5;
    const double row = tile_row * tile_side + i / tile_side + 0.5;
    looks.x[i] = bounds.min_x + (static_cast<double>(bounds.max_x) - bounds.min_x) * column / grid;
    looks.y[i] = bounds.min_y + (static_cast<double>(bounds.max_y) - bounds.min_y) * row / grid;
  }
  return looks;
}

/// Whether some pixel's light leaves in this direction. Far off the axis a distortion can fold back into the image: a
/// position counts only if its pixel leads back to it.
bool lights(const ProjectorModel& projector, const glm::dvec2& tangent) {
  const glm::dvec2 pixel = pixel_of_tangent(projector, tangent);
  if (!(pixel.x >= 0.0 && pixel.x <= projector.width_px && pixel.y >= 0.0 && pixel.y <= projector.height_px))
    return false;
  if (projector.distortion.empty()) return true;
  const glm::dvec2 back = tangent_of_pixel(projector, pixel);
  return std::abs(back.x - tangent.x) < 1e-6 && std::abs(back.y - tangent.y) < 1e-6;
}

/// Which of the points on surfaces the projector's light reaches.
std::vector<bool> reached(const Survey& survey, const Looks& looks, const Met& surface) {
  Looks towards;
  double depth_m[tile_samples];
  for (int i = 0; i < tile_samples; ++i) {
    towards.x[i] = towards.y[i] = nan;
    if (std::isnan(surface.depth_m[i])) continue;
    const glm::dvec3 in_eye = glm::dvec3(looks.x[i], looks.y[i], -1.0) * surface.depth_m[i];
    const glm::dvec3 point = survey.projector_from_eye.point(in_eye);
    depth_m[i] = -point.z;
    if (!(depth_m[i] > 0.0)) continue;
    const glm::dvec2 tangent{point.x / depth_m[i], point.y / depth_m[i]};
    if (!lights(survey.projector, tangent)) continue;
    towards.x[i] = tangent.x;
    towards.y[i] = tangent.y;
  }
  const Met first = nearest(survey.from_projector, towards);
  std::vector<bool> lit(tile_samples, false);
  for (std::size_t i = 0; i < tile_samples; ++i) {
    if (std::isnan(towards.x[i])) continue;
    lit[i] = std::isnan(first.depth_m[i]) || first.depth_m[i] >= depth_m[i] * (1.0 - shadow_tolerance);
  }
  return lit;
}

void survey_tile(const Survey& survey, const Looks& looks, std::vector<ObjectCoverage>& counts) {
  const Met object = nearest(survey.objects, looks);
  if (std::all_of(object.depth_m, object.depth_m + tile_samples, [](double d) { return std::isnan(d); })) return;
  const Met surface = nearest(survey.surfaces, looks);
  const std::vector<bool> lit = reached(survey, looks, surface);
  for (int i = 0; i < tile_samples; ++i) {
    if (std::isnan(object.depth_m[i])) continue;
    ObjectCoverage& count = counts[survey.object_drawables[object.drawable[i]].owner];
    ++count.looks;
    if (std::isnan(surface.depth_m[i])) {
      ++count.off_surface;
    } else if (!lit[static_cast<std::size_t>(i)]) {
      ++count.outside_projector;
    }
    const double off_axis_m = std::hypot(looks.x[i], looks.y[i]) * survey.lens_to_pupil_m;
    if (off_axis_m > survey.lens_aperture_m / 2.0) ++count.outside_lens;
  }
}

void add(ObjectCoverage& sum, const ObjectCoverage& part) {
  sum.looks += part.looks;
  sum.off_surface += part.off_surface;
  sum.outside_projector += part.outside_projector;
  sum.outside_lens += part.outside_lens;
}

}  // namespace

std::vector<ObjectCoverage> measure_coverage(const Stage& stage, const ProjectorModel& projector,
                                             double lens_to_pupil_m, double lens_aperture_m, int grid) {
  std::vector<ObjectCoverage> coverage(stage.objects.size());
  for (std::size_t i = 0; i < coverage.size(); ++i) coverage[i].index = stage.objects[i].index;
  const std::vector<ViewDrawable> objects = drawables_of(stage.objects);
  const std::vector<ViewDrawable> surfaces = drawables_of(stage.surfaces);
  const int tiles = std::max(1, (grid + tile_side - 1) / tile_side);
  const Rigid projector_from_world = projector.world_from_projector.inverse();
  const Sight from_projector(surfaces, projector_from_world, 1e-3, tiles);
  const PerEye<Eye> eyes = eyes_of(stage.world_from_viewer, stage.interpupillary_m, lens_to_pupil_m);
  for (const Side side : both_sides) {
    const Rigid& eye_from_world = eyes[side].eye_from_world;
    const Sight of_objects(objects, eye_from_world, nearest_seen_m(lens_to_pupil_m), tiles);
    if (of_objects.empty()) continue;
    const Sight of_surfaces(surfaces, eye_from_world, nearest_seen_m(lens_to_pupil_m), tiles);
    const Survey survey{
        of_objects,      of_surfaces,     from_projector, projector, projector_from_world * eye_from_world.inverse(),
        lens_to_pupil_m, lens_aperture_m, objects};
    std::vector<std::vector<ObjectCoverage>> rows(static_cast<std::size_t>(tiles),
                                                  std::vector<ObjectCoverage>(coverage.size()));
    tbb::parallel_for(0, tiles, [&](int row) {
      for (int column = 0; column < tiles; ++column) {
        survey_tile(survey, grid_looks(of_objects.bounds, tiles * tile_side, column, row),
                    rows[static_cast<std::size_t>(row)]);
      }
    });
    for (const auto& row : rows) {
      for (std::size_t i = 0; i < coverage.size(); ++i) add(coverage[i], row[i]);
    }
  }
  return coverage;
}

}  // namespace focalstage
