#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/compile/compile.h"
#include "core/retina/retina.h"
#include "tests/support/shapes.h"

namespace focalstage::retina_test {

/// Half a metre before the lens.
inline constexpr double screen_m = 0.515;

inline Rigid on_screen() { return {{0.0, 0.0, -screen_m}, {1, 0, 0, 0}}; }

/// A white screen of 1.6 x 1.2 m, 0.5 m before the lenses.
inline Stage screen_stage() {
  Stage stage;
  stage.surfaces = {support::surface_of(support::standing(support::rectangle({1.6, 1.2}), on_screen()))};
  return stage;
}

/// A projector of `width_px` x `height_px` at `from_m` that looks at the screen's centre.
inline ProjectorModel projector_at(const glm::dvec3& from_m, double focal_px, int width_px, int height_px) {
  ProjectorModel projector;
  projector.width_px = width_px;
  projector.height_px = height_px;
  projector.focal_px = glm::dvec2(focal_px);
  projector.centre_px = {width_px / 2.0, height_px / 2.0};
  projector.world_from_projector = support::looking(from_m, {0.0, 0.0, -screen_m});
  return projector;
}

/// A whole exposure at one power.
inline RetinaExposure shown(std::span<const std::uint8_t> codes, double power_d) { return {codes, {{power_d, 1.0}}}; }

inline RetinaInput input_of(const Stage& stage, const ProjectorModel& projector) {
  RetinaInput input;
  input.stage = &stage;
  input.projector = projector;
  return input;
}

/// What `side` gets of a compiled frame.
inline RetinaInput input_of(const Stage& stage, const CompileSettings& settings, const CompiledFrame& frame,
                            Side side) {
  RetinaInput input = input_of(stage, settings.projector);
  input.channels = settings.channels;
  input.bits = settings.bits;
  input.gamma = settings.gamma;
  input.lens_to_pupil_m = settings.lens_to_pupil_m;
  const ImageEye own = side == Side::left ? ImageEye::left : ImageEye::right;
  for (std::size_t i = 0; i < settings.images.size(); ++i) {
    const ImageSpec& spec = settings.images[i];
    if (spec.eye == own || spec.eye == ImageEye::both) {
      input.exposures.push_back(shown(frame.images.image(i), spec.power_d));
    }
  }
  return input;
}

/// Sums over the picture's first channel, in pixels.
struct Moments {
  double sum = 0.0;
  glm::dvec2 centre{0.0};
  double radius_px = 0.0;  ///< of the disc with that variance: r^2 / 4 along each axis
};

inline Moments moments_of(const RetinaImage& image) {
  Moments all;
  glm::dvec2 first(0.0), second(0.0);
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      const double light = image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width_px) +
                                          static_cast<std::size_t>(x))];
      const glm::dvec2 place(x + 0.5, y + 0.5);
      all.sum += light;
      first += light * place;
      second += light * place * place;
    }
  }
  all.centre = first / all.sum;
  const glm::dvec2 variance = second / all.sum - all.centre * all.centre;
  all.radius_px = std::sqrt(2.0 * (variance.x + variance.y));
  return all;
}

inline float at(const RetinaImage& image, int x, int y, int channel = 0) {
  return image
      .rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width_px) + static_cast<std::size_t>(x)) +
           static_cast<std::size_t>(channel)];
}

}  // namespace focalstage::retina_test
