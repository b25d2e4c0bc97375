#include "core/compile/need_meter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/compile/object_survey.h"
#include "core/optics/look.h"
#include "core/optics/vergence.h"

namespace focalstage {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int rounds = 3;                 ///< straight ahead, and twice to the point that the power names
constexpr double weight_per_area = 1e12;  ///< whole numbers of it add up the same in any order

/// The looks of one tile and what they meet of the objects.
struct Tile {
  Sight::Looks looks;
  std::int32_t drawable[tile_samples];
  double vergence_d[tile_samples];  ///< at which the picture is wanted
  bool any = false;
};

Tile look_at_objects(const SurveyEye& eye, int tile_column, int tile_row) {
  Tile tile;
  for (int i = 0; i < tile_samples; ++i) {
    const int column = tile_column * tile_side + i % tile_side;
    const int row = tile_row * tile_side + i / tile_side;
    tile.drawable[i] = eye.objects.met(column, row);
    tile.looks.x[i] = tile.looks.y[i] = nan;
    if (tile.drawable[i] < 0) continue;
    const glm::dvec2 look = eye.objects.look(column, row);
    tile.looks.x[i] = look.x;
    tile.looks.y[i] = look.y;
    const auto owner = eye.drawables[static_cast<std::size_t>(tile.drawable[i])].owner;
    tile.vergence_d[i] =
        wanted_vergence_d(eye.stage.objects[owner].depth, eye.objects.depth_m(column, row) - eye.lens_to_pupil_m);
    tile.any = true;
  }
  return tile;
}

/// The power that look `i` needs where the surface's `triangle` carries its picture.
double needed_d(const SurveyEye& eye, const Tile& tile, int i, const ViewTriangle& triangle, double depth_m) {
  const double plane_m = 1.0 / triangle.inverse_depth(tile.looks.x[i], tile.looks.y[i]) - eye.lens_to_pupil_m;
  const double surface_m = plane_m > 0.0 ? plane_m : depth_m - eye.lens_to_pupil_m;
  return 1.0 / surface_m - tile.vergence_d[i];
}

/// Where the surfaces carry the pictures of a tile, and through which power.
struct Carried {
  Sight::Looks straight;  ///< at the surface points
  Sight::Met met;
  double power_d[tile_samples];
};

/// `stretched`: breathing is compensated.
Carried carry(const SurveyEye& eye, bool stretched, const Tile& tile) {
  const Sight& surfaces = eye.surfaces.from_eye(eye.side);
  Carried carried;
  carried.straight = tile.looks;
  for (int round = 0;; ++round) {
    carried.met = surfaces.nearest(carried.straight);
    for (int i = 0; i < tile_samples; ++i) {
      if (!carried.met.at(i)) continue;
      carried.power_d[i] = needed_d(eye, tile, i, surfaces.triangle(carried.met, i), carried.met.depth_m[i]);
    }
    if (round + 1 == rounds || !stretched) return carried;
    for (int i = 0; i < tile_samples; ++i) {
      if (!carried.met.at(i)) continue;
      const double surface_m = carried.met.depth_m[i] - eye.lens_to_pupil_m;
      const double stretch = look_stretch(carried.power_d[i], surface_m, eye.lens_to_pupil_m);
      const bool bends = stretch > 0.0 && std::isfinite(stretch);
      carried.straight.x[i] = bends ? tile.looks.x[i] / stretch : nan;
      carried.straight.y[i] = bends ? tile.looks.y[i] / stretch : nan;
    }
  }
}

void survey_tile(const SurveyEye& eye, bool stretched, int tile_column, int tile_row, std::vector<ObjectNeeds>& needs) {
  const Tile tile = look_at_objects(eye, tile_column, tile_row);
  if (!tile.any) return;
  const Carried carried = carry(eye, stretched, tile);
  const auto weight = static_cast<std::uint64_t>(std::max(1.0, eye.objects.look_area() * weight_per_area));
  const auto lit = eye.surfaces.reached(eye.eye_from_world, carried.straight, carried.met);
  for (int i = 0; i < tile_samples; ++i) {
    if (tile.drawable[i] < 0) continue;
    ObjectNeeds& object = needs[eye.drawables[static_cast<std::size_t>(tile.drawable[i])].owner];
    ++object.looks;
    if (!carried.met.at(i)) {
      ++object.off_surface;
    } else if (!lit[static_cast<std::size_t>(i)]) {
      ++object.unlit;
    } else if (!object.pinned_slice) {
      object.powers[eye.side].add(carried.power_d[i], weight);
    }
  }
}

}  // namespace

struct NeedMeter::State {
  bool stretched;
  ObjectSurvey survey;
};

NeedMeter::NeedMeter(std::vector<ProjectorModel> projectors, double lens_to_pupil_m, Breathing breathing, int grid)
    : state_(new State{breathing != Breathing::off, ObjectSurvey(std::move(projectors), lens_to_pupil_m, grid)}) {}
NeedMeter::~NeedMeter() = default;
NeedMeter::NeedMeter(NeedMeter&&) noexcept = default;
NeedMeter& NeedMeter::operator=(NeedMeter&&) noexcept = default;

std::vector<ObjectNeeds> NeedMeter::measure(const Stage& stage) {
  std::vector<ObjectNeeds> empty(stage.objects.size());
  for (std::size_t i = 0; i < empty.size(); ++i) {
    const StagedObject& object = stage.objects[i];
    empty[i].index = object.index;
    if (object.depth.mode == DepthMode::slice) empty[i].pinned_slice = object.depth.index;
  }
  return state_->survey.add_up(stage, empty, [&](const SurveyEye& eye, int column, int row, auto& needs) {
    survey_tile(eye, state_->stretched, column, row, needs);
  });
}

}  // namespace focalstage
