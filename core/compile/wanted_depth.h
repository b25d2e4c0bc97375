#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/compile/eye_view.h"
#include "core/compile/kernel.h"
#include "core/compile/pixel_looks.h"

namespace focalstage {

/// Where light of an object is wanted, as an affine function of the inverse depth r at which the object stands (both
/// from the pupil): `per_inverse_m` r + `rest_d`, a vergence at the pupil.
struct WantedVergence {
  double per_inverse_m = 1.0;
  double rest_d = 0.0;

  double at(double inverse_m) const { return per_inverse_m * inverse_m + rest_d; }
};

/// `placed` stands where it is seen and `fixed` has one vergence, exactly. `offset` bends planes by d_e^2 of the offset
/// and is exact at `inverse_m`. What is pinned to a slice is wanted where a surface at `surface_m` shows that slice.
WantedVergence wanted_vergence(const VergenceRule& rule, const std::vector<SliceSetup>& slices, double surface_m,
                               double inverse_m, double lens_to_pupil_m);

/// What one eye wants of each pixel's straight look: [row][column] of the projector's raster.
struct WantedDepth {
  static constexpr float none = std::numeric_limits<float>::quiet_NaN();

  std::vector<float> vergence_d;  ///< at the pupil; NaN where no object or no surface is met
  std::vector<float> power_d;     ///< that shows it there
};

WantedDepth wanted_depth(const EyeView& view, const PixelLooks& looks, const std::vector<SliceSetup>& slices,
                         const Kernel& kernel);

/// Pixels at which the wanted vergence jumps so far that, with one side in focus, the other's blur reaches over: the
/// blur's diameter exceeds the distance of the pixels. There alone is linear filtering wrong: elsewhere the light of
/// both slices is spread over a picture that hardly changes within the blur. [row][column], 1 on both sides.
std::vector<std::uint8_t> depth_edges(const WantedDepth& wanted, const PixelLooks& looks, double pupil_m);

/// Marks everything within `reach` pixels of a mark, along rows and columns alike.
std::vector<std::uint8_t> widened(const std::vector<std::uint8_t>& marks, int width_px, int height_px, int reach);

}  // namespace focalstage
