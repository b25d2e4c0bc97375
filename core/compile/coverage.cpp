#include "core/compile/coverage.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/compile/cells.h"
#include "core/compile/kernel.h"
#include "core/compile/look_grid.h"
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

/// 64 looks and how far along the axis they met something (NaN: nothing).
struct Looks {
  double x[tile_samples];
  double y[tile_samples];
};
struct Met {
  double depth_m[tile_samples];
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
  }
  return met;
}

/// One eye at work.
struct Survey {
  const LookGrid& objects;
  const Sight& surfaces;
  const Sight& from_projector;
  const ProjectorModel& projector;
  Rigid projector_from_eye;
  double lens_to_pupil_m;
  double lens_aperture_m;
  const std::vector<ViewDrawable>& object_drawables;
};

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

void survey_tile(const Survey& survey, int tile_column, int tile_row, std::vector<ObjectCoverage>& counts) {
  Looks looks;
  std::int32_t object[tile_samples];
  for (int i = 0; i < tile_samples; ++i) {
    const int column = tile_column * tile_side + i % tile_side;
    const int row = tile_row * tile_side + i / tile_side;
    const glm::dvec2 look = survey.objects.look(column, row);
    looks.x[i] = look.x;
    looks.y[i] = look.y;
    object[i] = survey.objects.met(column, row);
  }
  if (std::all_of(object, object + tile_samples, [](std::int32_t drawable) { return drawable < 0; })) return;
  const Met surface = nearest(survey.surfaces, looks);
  const std::vector<bool> lit = reached(survey, looks, surface);
  for (int i = 0; i < tile_samples; ++i) {
    if (object[i] < 0) continue;
    ObjectCoverage& count = counts[survey.object_drawables[static_cast<std::size_t>(object[i])].owner];
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

/// All looks of one eye.
void survey_grid(const Survey& survey, int tiles, std::vector<ObjectCoverage>& coverage) {
  std::vector<std::vector<ObjectCoverage>> rows(static_cast<std::size_t>(tiles),
                                                std::vector<ObjectCoverage>(coverage.size()));
  tbb::parallel_for(0, tiles, [&](int row) {
    for (int column = 0; column < tiles; ++column) {
      survey_tile(survey, column, row, rows[static_cast<std::size_t>(row)]);
    }
  });
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < coverage.size(); ++i) add(coverage[i], row[i]);
  }
}

}  // namespace

struct CoverageMeter::State {
  ProjectorModel projector;
  double lens_to_pupil_m;
  double lens_aperture_m;
  int tiles;  ///< of the grid, along each side

  LookGrid grid;
  std::vector<StagedSurface> surfaces_before;
  Rigid viewer_before;
  double interpupillary_before_m = 0.0;
  std::optional<Sight> from_projector;
  PerEye<std::optional<Sight>> of_surfaces;

  /// How the projector and the eyes see the surfaces; kept while surfaces and viewer stand still.
  void look_at_surfaces(const Stage& stage, const PerEye<Eye>& eyes) {
    const bool same_surfaces = from_projector && surfaces_before == stage.surfaces;
    const bool same_viewer =
        same_surfaces && viewer_before == stage.world_from_viewer && interpupillary_before_m == stage.interpupillary_m;
    if (same_viewer) return;
    const std::vector<ViewDrawable> surfaces = drawables_of(stage.surfaces);
    if (!same_surfaces) from_projector.emplace(surfaces, projector.world_from_projector.inverse(), 1e-3, tiles);
    for (const Side side : both_sides) {
      of_surfaces[side].emplace(surfaces, eyes[side].eye_from_world, nearest_seen_m(lens_to_pupil_m), tiles);
    }
    surfaces_before = stage.surfaces;
    viewer_before = stage.world_from_viewer;
    interpupillary_before_m = stage.interpupillary_m;
  }
};

CoverageMeter::CoverageMeter(ProjectorModel projector, double lens_to_pupil_m, double lens_aperture_m, int grid)
    : state_(std::make_unique<State>()) {
  state_->projector = std::move(projector);
  state_->lens_to_pupil_m = lens_to_pupil_m;
  state_->lens_aperture_m = lens_aperture_m;
  state_->tiles = std::max(1, (grid + tile_side - 1) / tile_side);
}
CoverageMeter::~CoverageMeter() = default;
CoverageMeter::CoverageMeter(CoverageMeter&&) noexcept = default;
CoverageMeter& CoverageMeter::operator=(CoverageMeter&&) noexcept = default;

std::vector<ObjectCoverage> CoverageMeter::measure(const Stage& stage) {
  State& state = *state_;
  std::vector<ObjectCoverage> coverage(stage.objects.size());
  for (std::size_t i = 0; i < coverage.size(); ++i) coverage[i].index = stage.objects[i].index;
  const PerEye<Eye> eyes = eyes_of(stage.world_from_viewer, stage.interpupillary_m, state.lens_to_pupil_m);
  state.look_at_surfaces(stage, eyes);
  const std::vector<ViewDrawable> objects = drawables_of(stage.objects);
  const Rigid projector_from_world = state.projector.world_from_projector.inverse();
  for (const Side side : both_sides) {
    const Rigid& eye_from_world = eyes[side].eye_from_world;
    state.grid.lay(objects, eye_from_world, nearest_seen_m(state.lens_to_pupil_m), state.tiles * tile_side);
    if (state.grid.empty()) continue;
    const Survey survey{state.grid,
                        *state.of_surfaces[side],
                        *state.from_projector,
                        state.projector,
                        projector_from_world * eye_from_world.inverse(),
                        state.lens_to_pupil_m,
                        state.lens_aperture_m,
                        objects};
    survey_grid(survey, state.tiles, coverage);
  }
  return coverage;
}

}  // namespace focalstage
