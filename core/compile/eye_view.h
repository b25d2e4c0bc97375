#pragma once

#include <vector>

#include "core/compile/cells.h"
#include "core/compile/kernel.h"
#include "core/compile/shading.h"
#include "core/compile/surface_hits.h"
#include "core/compile/view_triangles.h"
#include "core/optics/assignment.h"
#include "core/stage/stage.h"

namespace focalstage {

/// One slice, ready for the kernel.
struct SliceSetup {
  double power_d = 0.0;
  float bend = 0.0f;  ///< power * lens_to_pupil; 0 where breathing is not compensated
  SliceBand band;
  float from_d = 0.0f;  ///< wanted powers that give it any weight
  float to_d = 0.0f;
  bool empty = false;  ///< repeats an earlier slice's power
};

std::vector<SliceSetup> slice_setups(const Slices& slices, double lens_to_pupil_m);

/// The virtual objects as one eye sees them: triangles in cells, their vergence rules and colours.
struct EyeView {
  double lens_to_pupil_m = 0.0;
  ViewTriangles view;
  Cells cells;
  std::vector<VergenceRule> rules;   ///< per drawable
  std::vector<Shader> shaders;       ///< per drawable
  std::vector<std::int32_t> first;   ///< per drawable: its lowest index among the triangles
  std::vector<std::uint32_t> owner;  ///< per drawable: index in the stage's objects
  bool cuts = false;                 ///< something is cut away by its texture's alpha
  bool one_rule = true;              ///< all rules are alike, none pins a slice
  bool nothing = true;               ///< no triangle can be met
};

/// Sets the view up for one frame; keeps the memory it already has.
void look_at_objects(EyeView& view, const Stage& stage, const std::vector<ViewDrawable>& objects, const Eye& eye,
                     const EyeHits& hits, const TileGrid& grid, const std::vector<SliceSetup>& slices);

/// Where the looks of `tile` through `slice` can fall in the tangent plane.
Box look_bounds(const EyeTile& tile, const SliceSetup& slice, double lens_to_pupil_m);

/// Whether the slice can have any light in the tile: a conservative answer from bounds alone.
bool may_be_lit(const EyeView& view, const EyeTile& tile, const SliceSetup& slice, std::size_t slice_index);

}  // namespace focalstage
