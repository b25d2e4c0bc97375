#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/sides.h"
#include "core/optics/image_plan.h"
#include "core/optics/projector_model.h"
#include "core/scene/project.h"

namespace focalstage {

/// Nothing nearer to the projector than this is lit.
inline constexpr double nearest_lit_m = 1e-3;

/// One of several projectors that light the same surfaces (docs/blending.md).
struct BlendProjector {
  ProjectorModel model;  ///< at full size
  double margin_px = 64.0;
  double black_level = 0.0;
  double level = 1.0;        ///< its full white at `reference_m`, against what counts as 1
  double reference_m = 1.0;  ///< on its axis

  bool operator==(const BlendProjector&) const = default;
};

/// All that decides the images of a frame apart from the stage.
struct CompileSettings {
  ProjectorModel projector;
  int channels = 1;  ///< 1 gray, 3 rgb
  int bits = 8;
  double gamma = 1.0;
  std::vector<double> transfer;  ///< in place of `gamma`; see Projector
  double black_level = 0.0;
  double lens_to_pupil_m = 0.015;
  double focus_m = 0.0;  ///< the projector's; 0: not known, no defocus is reported
  double depth_of_field_d = 0.0;
  double reference_m = 1.0;  ///< where light counts as 1, with compensation `even`
  Slices slices;
  std::vector<ImageSpec> images;
  std::vector<BlendProjector> blend{};  ///< all projectors of the project; none where it has but this one
  std::size_t blend_own = 0;            ///< which of them this is

  bool operator==(const CompileSettings&) const = default;
};

/// All projectors that light the surfaces: this one, or those of the blend.
std::vector<ProjectorModel> projectors_of(const CompileSettings& settings);

/// What the project's projector number `projector` needs.
CompileSettings compile_settings(const Project& project, std::size_t projector = 0);

/// The images of one frame: codes [count][height][width][channels].
struct FrameImages {
  std::size_t count = 0;
  int width_px = 0;
  int height_px = 0;
  int channels = 1;
  std::vector<std::uint8_t> codes;

  std::size_t bytes_per_image() const {
    return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) *
           static_cast<std::size_t>(channels);
  }
  std::span<const std::uint8_t> image(std::size_t i) const {
    return std::span(codes).subspan(i * bytes_per_image(), bytes_per_image());
  }
};

/// What compiling measured of one object, both eyes together.
struct ObjectMeasure {
  std::size_t index = 0;      ///< in the project's list
  std::uint64_t samples = 0;  ///< lit samples of slices
  std::uint64_t beyond = 0;   ///< those that want a power more than 0.3 D beyond the outermost slice
  double worst_beyond_d = 0.0;
  double worst_below_d = 0.0;  ///< the same below the lowest slice alone
  double worst_above_d = 0.0;  ///< and above the highest
};

/// What the pixels of one surface were asked for beyond what can be had, over all images of a frame; with compensation
/// alone. Shares of full white.
struct SurfaceAsked {
  std::size_t index = 0;                     ///< in the project's list
  std::uint64_t lit_pixels = 0;              ///< that show content or light
  std::uint64_t too_bright = 0;              ///< of those, wanted more than full white in some channel
  std::uint64_t too_dark = 0;                ///< wanted less than leaks through black
  std::array<std::uint64_t, 3> bright_in{};  ///< by channel
  std::array<std::uint64_t, 3> dark_in{};
  double most = 0.0;   ///< the most light wanted
  double least = 0.0;  ///< the least, below black: not above 0

  bool operator==(const SurfaceAsked&) const = default;
};

/// What the assignment `optimal` did for one eye: the error of the focal stack (what is seen at the focuses of the
/// slices and half-way between, against the virtual scene itself) over the pixels near depth edges, in linear light.
struct OptimalMeasure {
  std::uint64_t tiles = 0;           ///< of 8 x 8 pixels, near depth edges
  std::uint64_t accepted_tiles = 0;  ///< of those, where solving made the error smaller; the others stay linear
  std::uint64_t left_tiles = 0;      ///< more of them than time allows: linear
  std::uint64_t values = 0;          ///< pixels times focuses times channels
  double linear_error = 0.0;         ///< sum of squares over these, of linear filtering
  double optimal_error = 0.0;        ///< and of the images made

  bool operator==(const OptimalMeasure&) const = default;
};

/// How much closer the focal stack is than linear filtering's, as a difference of peak signal to noise ratios; 0 where
/// nothing was solved.
double gain_db(const OptimalMeasure& measure);

/// Peak signal to noise ratio of an error sum over the measure's values, full light being the peak.
double psnr_db(const OptimalMeasure& measure, double error);

/// Both together: of two frames, or of two eyes.
OptimalMeasure operator+(const OptimalMeasure& a, const OptimalMeasure& b);

/// What compiling measured of a frame.
struct FrameMeasure {
  std::uint64_t lit_pixels = 0;        ///< pixels above zero, over all images
  std::uint64_t clipped_pixels = 0;    ///< of those, wanted more than full light
  std::uint64_t surface_pixels = 0;    ///< projector pixels whose ray meets a surface
  std::uint64_t defocused_pixels = 0;  ///< of those, outside the projector's depth of field
  double worst_defocus_d = 0.0;
  std::vector<ObjectMeasure> objects;    ///< one per staged object
  PerEye<OptimalMeasure> optimal{};      ///< zero with other assignments
  std::vector<SurfaceAsked> surfaces{};  ///< one per staged surface; none without compensation
};

/// Where a frame's light could not be reached, in the projector's pixels: the worst over its images and channels.
struct ClipMap {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> bright;  ///< [row][column]: light wanted beyond full white, as a share of it; 0: reached
  std::vector<float> dark;    ///< how far below black, as a share of full white
};

struct CompiledFrame {
  FrameImages images;
  FrameMeasure measure;
};

}  // namespace focalstage
