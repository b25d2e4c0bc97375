#pragma once

#include <vector>

#include "core/base/sides.h"
#include "core/compile/frame.h"
#include "core/compile/slice_tile.h"
#include "core/compile/surface_hits.h"
#include "core/stage/stage.h"

namespace focalstage {

/// One frame at work: everything that its tiles read.
struct FrameRun {
  const CompileSettings* settings;
  const Stage* stage;
  const ProjectorRays* rays;
  const ProjectorHits* met;
  const std::vector<ViewDrawable>* surfaces;
  PerEye<const EyeHits*> hits;
  PerEye<const EyeView*> views;
  std::vector<SliceSetup> slices;
  SliceRun slice;
};

/// The linear light of one tile of an image, before it is encoded: what its slice shows, and surface light where the
/// image carries some. What was counted goes to `tallies`, one per object.
void light_of_tile(const FrameRun& run, const ImageSpec& image, int column, int row, TileLight& light,
                   std::vector<ObjectTally>& tallies);

/// Adds the surface light that falls on the pixels of one tile, of one sample each.
void add_surface_light(const FrameRun& run, const TileMet& met, TileLight& light);

}  // namespace focalstage
