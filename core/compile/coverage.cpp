#include "core/compile/coverage.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/compile/look_grid.h"
#include "core/compile/surface_hits.h"
#include "core/compile/surface_sights.h"
#include "core/optics/eye.h"

namespace focalstage {
namespace {

/// One eye at work.
struct Survey {
  const LookGrid& objects;
  const SurfaceSights& surfaces;
  Side side;
  Rigid eye_from_world;
  double lens_to_pupil_m;
  double lens_aperture_m;
  const std::vector<ViewDrawable>& object_drawables;
};

void survey_tile(const Survey& survey, int tile_column, int tile_row, std::vector<ObjectCoverage>& counts) {
  Sight::Looks looks;
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
  const Sight::Met surface = survey.surfaces.from_eye(survey.side).nearest(looks);
  const auto lit = survey.surfaces.reached(survey.eye_from_world, looks, surface);
  for (int i = 0; i < tile_samples; ++i) {
    if (object[i] < 0) continue;
    ObjectCoverage& count = counts[survey.object_drawables[static_cast<std::size_t>(object[i])].owner];
    ++count.looks;
    if (!surface.at(i)) {
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
  double lens_to_pupil_m;
  double lens_aperture_m;
  int tiles;  ///< of the grid, along each side
  SurfaceSights surfaces;
  LookGrid grid;
};

CoverageMeter::CoverageMeter(ProjectorModel projector, double lens_to_pupil_m, double lens_aperture_m, int grid) {
  const int tiles = tiles_across(grid);
  state_.reset(new State{
      lens_to_pupil_m, lens_aperture_m, tiles, SurfaceSights(std::move(projector), lens_to_pupil_m, tiles), {}});
}
CoverageMeter::~CoverageMeter() = default;
CoverageMeter::CoverageMeter(CoverageMeter&&) noexcept = default;
CoverageMeter& CoverageMeter::operator=(CoverageMeter&&) noexcept = default;

std::vector<ObjectCoverage> CoverageMeter::measure(const Stage& stage) {
  State& state = *state_;
  std::vector<ObjectCoverage> coverage(stage.objects.size());
  for (std::size_t i = 0; i < coverage.size(); ++i) coverage[i].index = stage.objects[i].index;
  const PerEye<Eye> eyes = eyes_of(stage.world_from_viewer, stage.interpupillary_m, state.lens_to_pupil_m);
  state.surfaces.look(stage, eyes);
  const std::vector<ViewDrawable> objects = drawables_of(stage.objects);
  for (const Side side : both_sides) {
    const Rigid& eye_from_world = eyes[side].eye_from_world;
    state.grid.lay(objects, eye_from_world, nearest_seen_m(state.lens_to_pupil_m), state.tiles * tile_side);
    if (state.grid.empty()) continue;
    const Survey survey{state.grid, state.surfaces, side, eye_from_world, state.lens_to_pupil_m, state.lens_aperture_m,
                        objects};
    survey_grid(survey, state.tiles, coverage);
  }
  return coverage;
}

}  // namespace focalstage
