#include "core/compile/need_meter.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/compile/look_grid.h"
#include "core/compile/surface_hits.h"
#include "core/compile/surface_sights.h"
#include "core/optics/eye.h"
#include "core/optics/look.h"
#include "core/optics/vergence.h"

namespace focalstage {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int rounds = 3;                 ///< straight ahead, and twice to the point that the power names
constexpr double weight_per_area = 1e12;  ///< whole numbers of it add up the same in any order

/// One eye at work.
struct Survey {
  const Stage& stage;
  const LookGrid& objects;
  const std::vector<ViewDrawable>& object_drawables;
  const SurfaceSights& surfaces;
  Side side;
  Rigid eye_from_world;
  double lens_to_pupil_m;
  bool stretched;  ///< breathing is compensated
  std::uint64_t weight;
};

/// The looks of one tile and what they meet of the objects.
struct Tile {
  Sight::Looks looks;
  std::int32_t drawable[tile_samples];
  double vergence_d[tile_samples];  ///< at which the picture is wanted
  bool any = false;
};

Tile look_at_objects(const Survey& survey, int tile_column, int tile_row) {
  Tile tile;
  for (int i = 0; i < tile_samples; ++i) {
    const int column = tile_column * tile_side + i % tile_side;
    const int row = tile_row * tile_side + i / tile_side;
    tile.drawable[i] = survey.objects.met(column, row);
    tile.looks.x[i] = tile.looks.y[i] = nan;
    if (tile.drawable[i] < 0) continue;
    const glm::dvec2 look = survey.objects.look(column, row);
    tile.looks.x[i] = look.x;
    tile.looks.y[i] = look.y;
    const auto owner = survey.object_drawables[static_cast<std::size_t>(tile.drawable[i])].owner;
    tile.vergence_d[i] = wanted_vergence_d(survey.stage.objects[owner].depth,
                                           survey.objects.depth_m(column, row) - survey.lens_to_pupil_m);
    tile.any = true;
  }
  return tile;
}

/// The power that look `i` needs where the surface's `triangle` carries its picture.
double needed_d(const Survey& survey, const Tile& tile, int i, const ViewTriangle& triangle, double depth_m) {
  const double plane_m = 1.0 / triangle.inverse_depth(tile.looks.x[i], tile.looks.y[i]) - survey.lens_to_pupil_m;
  const double surface_m = plane_m > 0.0 ? plane_m : depth_m - survey.lens_to_pupil_m;
  return 1.0 / surface_m - tile.vergence_d[i];
}

/// Where the surfaces carry the pictures of a tile, and through which power.
struct Carried {
  Sight::Looks straight;  ///< at the surface points
  Sight::Met met;
  double power_d[tile_samples];
};

Carried carry(const Survey& survey, const Tile& tile) {
  const Sight& surfaces = survey.surfaces.from_eye(survey.side);
  Carried carried;
  carried.straight = tile.looks;
  for (int round = 0;; ++round) {
    carried.met = surfaces.nearest(carried.straight);
    for (int i = 0; i < tile_samples; ++i) {
      if (!carried.met.at(i)) continue;
      carried.power_d[i] = needed_d(survey, tile, i, surfaces.triangle(carried.met, i), carried.met.depth_m[i]);
    }
    if (round + 1 == rounds || !survey.stretched) return carried;
    for (int i = 0; i < tile_samples; ++i) {
      if (!carried.met.at(i)) continue;
      const double surface_m = carried.met.depth_m[i] - survey.lens_to_pupil_m;
      const double stretch = look_stretch(carried.power_d[i], surface_m, survey.lens_to_pupil_m);
      const bool bends = stretch > 0.0 && std::isfinite(stretch);
      carried.straight.x[i] = bends ? tile.looks.x[i] / stretch : nan;
      carried.straight.y[i] = bends ? tile.looks.y[i] / stretch : nan;
    }
  }
}

void survey_tile(const Survey& survey, int tile_column, int tile_row, std::vector<ObjectNeeds>& needs) {
  const Tile tile = look_at_objects(survey, tile_column, tile_row);
  if (!tile.any) return;
  const Carried carried = carry(survey, tile);
  const auto lit = survey.surfaces.reached(survey.eye_from_world, carried.straight, carried.met);
  for (int i = 0; i < tile_samples; ++i) {
    if (tile.drawable[i] < 0) continue;
    ObjectNeeds& object = needs[survey.object_drawables[static_cast<std::size_t>(tile.drawable[i])].owner];
    ++object.looks;
    if (!carried.met.at(i)) {
      ++object.off_surface;
    } else if (!lit[static_cast<std::size_t>(i)]) {
      ++object.unlit;
    } else if (!object.pinned_slice) {
      object.powers[survey.side].add(carried.power_d[i], survey.weight);
    }
  }
}

}  // namespace

struct NeedMeter::State {
  double lens_to_pupil_m;
  Breathing breathing;
  int tiles;  ///< of the grid, along each side
  SurfaceSights surfaces;
  LookGrid grid;
};

NeedMeter::NeedMeter(ProjectorModel projector, double lens_to_pupil_m, Breathing breathing, int grid) {
  const int tiles = tiles_across(grid);
  state_.reset(
      new State{lens_to_pupil_m, breathing, tiles, SurfaceSights(std::move(projector), lens_to_pupil_m, tiles), {}});
}
NeedMeter::~NeedMeter() = default;
NeedMeter::NeedMeter(NeedMeter&&) noexcept = default;
NeedMeter& NeedMeter::operator=(NeedMeter&&) noexcept = default;

std::vector<ObjectNeeds> NeedMeter::measure(const Stage& stage) {
  State& state = *state_;
  std::vector<ObjectNeeds> empty(stage.objects.size());
  for (std::size_t i = 0; i < empty.size(); ++i) {
    const StagedObject& object = stage.objects[i];
    empty[i].index = object.index;
    if (object.depth.mode == DepthMode::slice) empty[i].pinned_slice = object.depth.index;
  }
  std::vector<ObjectNeeds> sum = empty;
  const PerEye<Eye> eyes = eyes_of(stage.world_from_viewer, stage.interpupillary_m, state.lens_to_pupil_m);
  state.surfaces.look(stage, eyes);
  const std::vector<ViewDrawable> objects = drawables_of(stage.objects);
  for (const Side side : both_sides) {
    const Rigid& eye_from_world = eyes[side].eye_from_world;
    state.grid.lay(objects, eye_from_world, nearest_seen_m(state.lens_to_pupil_m), state.tiles * tile_side);
    if (state.grid.empty()) continue;
    const auto weight = static_cast<std::uint64_t>(std::max(1.0, state.grid.look_area() * weight_per_area));
    const Survey survey{stage,
                        state.grid,
                        objects,
                        state.surfaces,
                        side,
                        eye_from_world,
                        state.lens_to_pupil_m,
                        state.breathing != Breathing::off,
                        weight};
    std::vector<std::vector<ObjectNeeds>> rows(static_cast<std::size_t>(state.tiles), empty);
    tbb::parallel_for(0, state.tiles, [&](int row) {
      for (int column = 0; column < state.tiles; ++column) {
        survey_tile(survey, column, row, rows[static_cast<std::size_t>(row)]);
      }
    });
    for (const auto& row : rows) {
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i].add(row[i]);
    }
  }
  return sum;
}

}  // namespace focalstage
