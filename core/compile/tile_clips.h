#pragma once

#include <vector>

#include "core/compile/frame.h"
#include "core/compile/slice_tile.h"
#include "core/compile/surface_gain.h"
#include "core/compile/surface_hits.h"
#include "core/compile/view_triangles.h"

namespace focalstage {

/// The rounding of sums of weights is no clipping.
inline constexpr float clip_tolerance = 1e-4f;

/// From light that is to come back to light that has to be given, less what leaks anyway (docs/colour.md). `leak`:
/// SurfaceGains'; it is taken off by the weights that the tile keeps.
void compensate_content(const TileGain& gain, float leak, int channels, TileLight& light);

void scale_surface_light(const TileGain& gain, int channels, TileLight& light);
void add_light(const TileLight& from, int channels, TileLight& onto);

/// Counts what the pixels of a tile want beyond full white and below black, by the surface that they light (with their
/// first sample). `asked`: one per staged surface.
void count_asked(const TileLight& light, const TileMet& met, const std::vector<ViewDrawable>& surfaces, int channels,
                 std::vector<SurfaceAsked>& asked);
void add_asked(const SurfaceAsked& more, SurfaceAsked& sum);

ClipMap no_clips(int width_px, int height_px);
void mark_clips(const TileLight& light, int channels, int column, int row, ClipMap& clips);

}  // namespace focalstage
