#include "core/compile/coverage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/compile/object_survey.h"

namespace focalstage {
namespace {

void survey_tile(const SurveyEye& eye, double lens_aperture_m, int tile_column, int tile_row,
                 std::vector<ObjectCoverage>& counts) {
  Sight::Looks looks;
  std::int32_t object[tile_samples];
  for (int i = 0; i < tile_samples; ++i) {
    const int column = tile_column * tile_side + i % tile_side;
    const int row = tile_row * tile_side + i / tile_side;
    const glm::dvec2 look = eye.objects.look(column, row);
    looks.x[i] = look.x;
    looks.y[i] = look.y;
    object[i] = eye.objects.met(column, row);
  }
  if (std::all_of(object, object + tile_samples, [](std::int32_t drawable) { return drawable < 0; })) return;
  const Sight::Met surface = eye.surfaces.from_eye(eye.side).nearest(looks);
  const auto lit = eye.surfaces.reached(eye.eye_from_world, looks, surface);
  for (int i = 0; i < tile_samples; ++i) {
    if (object[i] < 0) continue;
    ObjectCoverage& count = counts[eye.drawables[static_cast<std::size_t>(object[i])].owner];
    ++count.looks;
    if (!surface.at(i)) {
      ++count.off_surface;
    } else if (!lit[static_cast<std::size_t>(i)]) {
      ++count.outside_projector;
    }
    const double off_axis_m = std::hypot(looks.x[i], looks.y[i]) * eye.lens_to_pupil_m;
    if (off_axis_m > lens_aperture_m / 2.0) ++count.outside_lens;
  }
}

}  // namespace

void ObjectCoverage::add(const ObjectCoverage& more) {
  looks += more.looks;
  off_surface += more.off_surface;
  outside_projector += more.outside_projector;
  outside_lens += more.outside_lens;
}

struct CoverageMeter::State {
  double lens_aperture_m;
  ObjectSurvey survey;
};

CoverageMeter::CoverageMeter(std::vector<ProjectorModel> projectors, double lens_to_pupil_m, double lens_aperture_m,
                             int grid)
    : state_(new State{lens_aperture_m, ObjectSurvey(std::move(projectors), lens_to_pupil_m, grid)}) {}
CoverageMeter::~CoverageMeter() = default;
CoverageMeter::CoverageMeter(CoverageMeter&&) noexcept = default;
CoverageMeter& CoverageMeter::operator=(CoverageMeter&&) noexcept = default;

std::vector<ObjectCoverage> CoverageMeter::measure(const Stage& stage) {
  std::vector<ObjectCoverage> empty(stage.objects.size());
  for (std::size_t i = 0; i < empty.size(); ++i) empty[i].index = stage.objects[i].index;
  return state_->survey.add_up(stage, empty, [&](const SurveyEye& eye, int column, int row, auto& counts) {
    survey_tile(eye, state_->lens_aperture_m, column, row, counts);
  });
}

}  // namespace focalstage
