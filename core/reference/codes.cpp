#include "core/reference/codes.h"

#include <algorithm>
#include <cmath>

namespace focalstage {
namespace {

/// Where along a measured transfer function, 0 to 1, it last has this light.
double place_in(const std::vector<double>& transfer, double light) {
  const std::size_t steps = transfer.size() - 1;
  for (std::size_t i = steps; i-- > 0;) {
    const double low = transfer[i], high = transfer[i + 1];
    if (light < low) continue;
    const double share = light >= high ? 1.0 : (light - low) / (high - low);
    return (static_cast<double>(i) + share) / static_cast<double>(steps);
  }
  return 0.0;
}

}  // namespace

std::uint8_t code_of(double light, const CompileSettings& settings) {
  if (!(light > 0.0)) return 0;
  const double levels = std::exp2(settings.bits) - 1.0;
  if (settings.transfer.empty())
    return static_cast<std::uint8_t>(std::floor(levels * std::pow(std::min(1.0, light), 1.0 / settings.gamma) + 0.5));
  return static_cast<std::uint8_t>(std::floor(levels * place_in(settings.transfer, std::min(1.0, light)) + 0.5));
}

void count_asked(const glm::dvec3& light, int channels, SurfaceAsked& asked) {
  const double most = std::max(0.0, std::max(light.x, std::max(light.y, light.z)));
  const double least = std::min(0.0, std::min(light.x, std::min(light.y, light.z)));
  if (most == 0.0 && least == 0.0) return;
  ++asked.lit_pixels;
  if (most > full_light) ++asked.too_bright;
  if (least < 1.0 - full_light) ++asked.too_dark;
  for (int c = 0; c < channels; ++c) {
    if (light[c] > full_light) ++asked.bright_in[static_cast<std::size_t>(c)];
    if (light[c] < 1.0 - full_light) ++asked.dark_in[static_cast<std::size_t>(c)];
  }
  asked.most = std::max(asked.most, most);
  asked.least = std::min(asked.least, least);
}

void add(const SurfaceAsked& row, SurfaceAsked& sum) {
  sum.lit_pixels += row.lit_pixels;
  sum.too_bright += row.too_bright;
  sum.too_dark += row.too_dark;
  for (std::size_t c = 0; c < 3; ++c) {
    sum.bright_in[c] += row.bright_in[c];
    sum.dark_in[c] += row.dark_in[c];
  }
  sum.most = std::max(sum.most, row.most);
  sum.least = std::min(sum.least, row.least);
}

}  // namespace focalstage
