#pragma once

#include <vector>

#include "core/compile/eye_view.h"
#include "core/compile/frame.h"
#include "core/compile/pixel_looks.h"
#include "core/compile/surface_hits.h"
#include "core/compile/wanted_depth.h"

namespace focalstage {

/// A stage as far as one eye's parts of the engine need it. The stage must outlive it.
struct EyeRoom {
  CompileSettings settings;
  std::vector<ViewDrawable> surfaces;
  std::vector<ViewDrawable> objects;
  Eye eye;
  ProjectorRays rays;
  ProjectorHits met;
  EyeHits hits;
  PixelLooks looks;
  std::vector<SliceSetup> slices;
  EyeView view;

  EyeRoom(const Stage& stage, const CompileSettings& with, Side side = Side::left)
      : settings(with),
        surfaces(drawables_of(stage.surfaces)),
        objects(drawables_of(stage.objects)),
        eye(eyes_of(stage.world_from_viewer, stage.interpupillary_m, with.lens_to_pupil_m)[side]),
        rays(projector_rays(with.projector, with.slices.samples_per_pixel)),
        met(projector_hits(rays, with.projector, surfaces, best_kernel())),
        hits(eye_hits(met, rays.grid, with.projector.world_from_projector, eye, surfaces, with.slices.breathing,
                      best_kernel())),
        looks(pixel_looks(hits, rays.grid, rays.subsamples, with.lens_to_pupil_m)),
        slices(slice_setups(with.slices, with.lens_to_pupil_m)) {
    look_at_objects(view, stage, objects, eye, hits, rays.grid, slices);
  }

  const LookTile& tile(int x, int y) const {
    return looks.tiles[static_cast<std::size_t>(y / tile_side * looks.grid.columns() + x / tile_side)];
  }
  std::size_t place(int x, int y) const { return static_cast<std::size_t>(y * looks.grid.width_px + x); }
  WantedDepth wanted() const { return wanted_depth(view, looks, slices, best_kernel()); }
};

}  // namespace focalstage
