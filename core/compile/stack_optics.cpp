#include "core/compile/stack_optics.h"

#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/mat2x2.hpp>

#include "core/compile/ray_samples.h"
#include "core/optics/vergence.h"

namespace focalstage {
namespace {

void set_vergences(StackTile& tile, const LookTile& looks, const StackPlan& plan, const std::vector<SliceSetup>& slices,
                   double lens_to_pupil_m) {
  const auto at_pupil_d = [&](double power_d) {
    return vergence_at_pupil_d(image_vergence_d(looks.surface_mean_m, power_d), lens_to_pupil_m);
  };
  double before_d = 0.0;
  for (std::size_t n = 0; n < plan.slice_count(); ++n) {
    const double power_d = slices[plan.slices[n]].power_d;
    if (n > 0) tile.focus_d.push_back(at_pupil_d(0.5 * (before_d + power_d)));
    tile.focus_d.push_back(at_pupil_d(power_d));
    tile.slice_d.push_back(at_pupil_d(power_d));
    before_d = power_d;
  }
}

/// Every ray of a cell falls between four pixels of a slice and takes of each the part that a pixel's square, moved
/// there, covers of it.
void add_span(StackTile& tile, const glm::dmat2& px_per_ray, const glm::dvec2& shift) {
  const auto& samples = ray_samples();
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high = -low;
  for (const RaySample& sample : samples) {
    const glm::dvec2 at = px_per_ray * sample.pupil - shift;
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  StackSpan span;
  span.x = static_cast<int>(std::floor(low.x));
  span.y = static_cast<int>(std::floor(low.y));
  span.width = static_cast<int>(std::floor(high.x)) + 2 - span.x;
  span.height = static_cast<int>(std::floor(high.y)) + 2 - span.y;
  span.first = tile.shares.size();
  std::vector<double> shares(static_cast<std::size_t>(span.width) * static_cast<std::size_t>(span.height), 0.0);
  for (const RaySample& sample : samples) {
    const glm::dvec2 at = px_per_ray * sample.pupil - shift - glm::dvec2(span.x, span.y);
    const glm::dvec2 whole = glm::floor(at);
    const glm::dvec2 part = at - whole;
    const auto first =
        static_cast<std::size_t>(whole.y) * static_cast<std::size_t>(span.width) + static_cast<std::size_t>(whole.x);
    shares[first] += (1.0 - part.x) * (1.0 - part.y);
    shares[first + 1] += part.x * (1.0 - part.y);
    shares[first + static_cast<std::size_t>(span.width)] += (1.0 - part.x) * part.y;
    shares[first + static_cast<std::size_t>(span.width) + 1] += part.x * part.y;
  }
  for (const double share : shares) tile.shares.push_back(static_cast<float>(share / rays_per_pixel));
  tile.spans.push_back(span);
}

}  // namespace

/// How far slices lie beside the straight looks, in pixels: the lens' stretch less one times the look.
glm::dvec2 shift_px(const LookTile& tile, const SliceSetup& slice, double lens_to_pupil_m) {
  const double bent = static_cast<double>(slice.bend) * tile.stretch_mean_m;
  const double stretch_less_one = bent / (tile.stretch_mean_m + lens_to_pupil_m - bent);
  return tile.pixel_per_look * (tile.look * stretch_less_one);
}

void set_optics(StackTile& tile, const LookTile& looks, const StackPlan& plan, const std::vector<SliceSetup>& slices,
                double lens_to_pupil_m) {
  set_vergences(tile, looks, plan, slices, lens_to_pupil_m);
  for (std::size_t n = 0; n < plan.slice_count(); ++n) {
    const glm::dvec2 shift = shift_px(looks, slices[plan.slices[n]], lens_to_pupil_m);
    for (std::size_t k = 0; k < plan.focus_count(); ++k) {
      const double blur = plan.pupil_m / 2.0 * (tile.slice_d[n] - tile.focus_d[k]);
      add_span(tile, looks.pixel_per_look * blur, shift);
    }
  }
}

}  // namespace focalstage
