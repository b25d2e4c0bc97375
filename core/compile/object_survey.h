#pragma once

#include <tbb/parallel_for.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "core/compile/look_grid.h"
#include "core/compile/surface_hits.h"
#include "core/compile/surface_sights.h"
#include "core/compile/tile.h"
#include "core/optics/eye.h"
#include "core/stage/stage.h"

namespace focalstage {

/// One eye at the looks of a survey.
struct SurveyEye {
  const Stage& stage;
  const std::vector<ViewDrawable>& drawables;  ///< of the stage's objects
  const LookGrid& objects;
  const SurfaceSights& surfaces;
  Side side;
  Rigid eye_from_world;
  double lens_to_pupil_m;
};

/// Looks from both pupils over a regular grid about as fine as `grid` x `grid` over the objects of stage after stage.
/// Keeps how the eyes and the projectors see the surfaces while those stand still.
class ObjectSurvey {
 public:
  ObjectSurvey(std::vector<ProjectorModel> projectors, double lens_to_pupil_m, int grid)
      : lens_to_pupil_m_(lens_to_pupil_m),
        tiles_(tiles_across(grid)),
        surfaces_(std::move(projectors), lens_to_pupil_m, tiles_) {}

  /// Adds up `survey_tile(eye, tile_column, tile_row, sums)` over all tiles of looks and both eyes; rows of tiles count
  /// beside each other, each from `empty`. `Sum` has `add`, whose order of calls does not matter.
  template <class Sum, class SurveyTile>
  std::vector<Sum> add_up(const Stage& stage, const std::vector<Sum>& empty, const SurveyTile& survey_tile);

 private:
  double lens_to_pupil_m_;
  int tiles_;  ///< of the grid, along each side
  SurfaceSights surfaces_;
  LookGrid objects_;
};

template <class Sum, class SurveyTile>
std::vector<Sum> ObjectSurvey::add_up(const Stage& stage, const std::vector<Sum>& empty,
                                      const SurveyTile& survey_tile) {
  std::vector<Sum> sums = empty;
  const PerEye<Eye> eyes = eyes_of(stage.world_from_viewer, stage.interpupillary_m, lens_to_pupil_m_);
  surfaces_.look(stage, eyes);
  const std::vector<ViewDrawable> drawables = drawables_of(stage.objects);
  for (const Side side : both_sides) {
    const Rigid& eye_from_world = eyes[side].eye_from_world;
    objects_.lay(drawables, eye_from_world, nearest_seen_m(lens_to_pupil_m_), tiles_ * tile_side);
    if (objects_.empty()) continue;
    const SurveyEye eye{stage, drawables, objects_, surfaces_, side, eye_from_world, lens_to_pupil_m_};
    std::vector<std::vector<Sum>> rows(static_cast<std::size_t>(tiles_), empty);
    tbb::parallel_for(0, tiles_, [&](int row) {
      for (int column = 0; column < tiles_; ++column) {
        survey_tile(eye, column, row, rows[static_cast<std::size_t>(row)]);
      }
    });
    for (const std::vector<Sum>& row : rows) {
      for (std::size_t i = 0; i < sums.size(); ++i) sums[i].add(row[i]);
    }
  }
  return sums;
}

}  // namespace focalstage
