#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/result.h"
#include "core/base/sides.h"
#include "core/optics/power_share.h"
#include "core/optics/projector_model.h"
#include "core/stage/stage.h"

namespace focalstage {

// What one eye sees of a show: the exposures of one period, each through the lens powers that pass meanwhile, added in
// linear light.
//
// The layered answer, fast enough to follow a hand: directions are those of the thin lens (design section 5), an
// exposure is cut into as many powers as the picture can tell apart, defocus is the pupil's disc. What it is held
// against integrates rays (core/reference/seen.h).

/// One exposure that reaches the eye, its own or one that leaks in.
struct RetinaExposure {
  std::span<const std::uint8_t> codes;  ///< [height][width][channels] of the projector's image
  std::vector<PowerShare> powers;       ///< of the lens meanwhile, in time order
  bool own = true;                      ///< meant for this eye
};

/// The projector's own blur: a disc in its image, as wide as a pixel (on a diamond lattice: as columns are apart) at
/// either end of its depth of field.
struct ProjectorFocus {
  double focus_d = 0.0;           ///< 1 / distance along its axis
  double depth_of_field_d = 0.0;  ///< the whole; 0: sharp everywhere

  bool operator==(const ProjectorFocus&) const = default;
};

/// The rig and what it shows this eye.
struct RetinaInput {
  const Stage* stage = nullptr;  ///< surfaces with their albedo, and viewer; virtual objects do not matter
  ProjectorModel projector;
  int channels = 1;  ///< 1 gray, 3 rgb
  int bits = 8;
  double gamma = 1.0;
  std::vector<double> transfer{};  ///< in place of `gamma`; see Projector
  double black_level = 0.0;        ///< what every exposure leaks, as a share of full white
  double level = 1.0;              ///< how much brighter its full white is than what counts as 1
  /// Light thins with distance and angle as pixels do, 1 being what falls on the axis this far away; none: all alike.
  std::optional<double> falloff_reference_m{};
  std::vector<PowerShare>
      ambient{};  ///< the room's light on white, in full codes, and the lens powers it is seen through
  double lens_to_pupil_m = 0.015;
  double lens_aperture_m = 0.016;  ///< diameter; rays that miss it are lost
  ProjectorFocus projector_focus;
  std::vector<RetinaExposure> exposures;
};

/// How the eye looks: a picture of square pixels in its tangent plane.
struct RetinaView {
  Side eye = Side::left;
  double focus_d = 2.0;    ///< accommodation, as the vergence from the lens centre of what is sharp (design's 1/d_v)
  double pupil_m = 0.004;  ///< diameter
  /// Blur by the pupil's edge: as wide as a disc of the same spread as the Gaussian next to the Airy pattern, sigma
  /// 0.42 wavelengths over the pupil (550 nm).
  bool diffraction = false;
  /// The eye's longitudinal chromatic aberration: the chromatic eye of Thibos et al. 1992, at 610, 550 and 465 nm about
  /// 550. White light of a gray show is split into these three.
  bool chromatic = false;
  int width_px = 400;
  int height_px = 300;
  double fov_deg = 50.0;          ///< horizontal
  glm::dvec2 gaze{0.0};           ///< the look at the picture's centre
  glm::dvec3 head_offset_m{0.0};  ///< the head moved, in the viewer's axes, under images made for where it was

  bool operator==(const RetinaView&) const = default;
};

/// The look through a place of the picture; pixel i covers [i, i + 1), the origin is the top left corner.
glm::dvec2 look_of_pixel(const RetinaView& view, const glm::dvec2& pixel);
glm::dvec2 pixel_of_look(const RetinaView& view, const glm::dvec2& look);

/// Linear light, 1 = full code of one whole exposure; rows from the top, three values per pixel.
struct RetinaImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> rgb;
};

/// What is seen along a look.
struct RetinaSight {
  glm::dvec3 world_m{0.0};  ///< the spot of the surface that carries most of its light
  double surface_m = 0.0;   ///< how far that lies from the lens centre, along the gaze
  double vergence_d =
      0.0;           ///< where its picture lies (1/d_v), as a mean of the exposures by luminance: the focus it asks
  bool lit = false;  ///< no light: vergence and spot are the bare surface's, seen through no power
};

/// The accommodation that a show asks for, pixel by pixel: where the pictures lie whose light is seen there, before any
/// blur. As a mean over the exposures by their light: depth filtering shares light out so that the sharpest picture
/// lies there (MacKenzie et al. 2010). Rows from the top; vergences at the lens centre.
struct DrivenFocus {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> luminance;   ///< linear light; 0: dark
  std::vector<float> vergence_d;  ///< not a number where dark
  std::vector<float> spread_d;    ///< the root mean square of the exposures' vergences about that
};

/// What keeps an input or a view from meaning anything: a Fault "retina.input".
Status check_retina(const RetinaInput& input, const RetinaView& view);

/// Keeps between calls what did not change: where the looks of each slice meet surfaces that stand still, and which
/// pixel of the projector lights those spots. Focus, pupil and images can change at the cost of sampling and blurring.
class Retina {
 public:
  explicit Retina(int threads = 0);  ///< 0: all
  ~Retina();
  Retina(Retina&&) noexcept;
  Retina& operator=(Retina&&) noexcept;

  /// Faults: "retina.input" (sizes that don't fit, numbers that mean nothing), "retina.cancelled" within milliseconds
  /// of a stop request.
  Result<RetinaImage> view(const RetinaInput& input, const RetinaView& view, std::stop_token stop = {});

  /// Faults as above.
  Result<DrivenFocus> driven_focus(const RetinaInput& input, const RetinaView& view, std::stop_token stop = {});

  /// What is seen along `look`: for "focus here". None outside the picture, or where no surface is seen.
  Result<std::optional<RetinaSight>> look_at(const RetinaInput& input, const RetinaView& view, const glm::dvec2& look,
                                             std::stop_token stop = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace focalstage
