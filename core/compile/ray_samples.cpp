#include "core/compile/ray_samples.h"

#include <cmath>

namespace focalstage {
namespace {

double fraction(double value) { return value - std::floor(value); }

std::array<RaySample, rays_per_pixel> make_samples() {
  constexpr double golden_angle = 2.399963229728653;
  constexpr double plastic = 1.324717957244746;
  std::array<RaySample, rays_per_pixel> samples{};
  glm::dvec2 pupil_sum(0.0);
  glm::dvec2 pixel_sum(0.0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto k = static_cast<double>(i);
    const double radius = std::sqrt((k + 0.5) / rays_per_pixel);
    samples[i].pupil = radius * glm::dvec2(std::cos(k * golden_angle), std::sin(k * golden_angle));
    samples[i].pixel = {fraction(0.5 + k / plastic) - 0.5, fraction(0.5 + k / (plastic * plastic)) - 0.5};
    pupil_sum += samples[i].pupil;
    pixel_sum += samples[i].pixel;
  }
  for (RaySample& sample : samples) {  // nothing may be shifted as a whole
    sample.pupil -= pupil_sum / static_cast<double>(rays_per_pixel);
    sample.pixel -= pixel_sum / static_cast<double>(rays_per_pixel);
  }
  return samples;
}

}  // namespace

const std::array<RaySample, rays_per_pixel>& ray_samples() {
  static const std::array<RaySample, rays_per_pixel> samples = make_samples();
  return samples;
}

}  // namespace focalstage
