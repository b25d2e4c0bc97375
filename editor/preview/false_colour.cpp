#include "editor/preview/false_colour.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace focalstage {
namespace {

int brightest(std::span<const std::uint8_t> codes, std::size_t pixel, int channels) {
  const auto own = codes.subspan(pixel * static_cast<std::size_t>(channels), static_cast<std::size_t>(channels));
  return *std::max_element(own.begin(), own.end());
}

/// A dim pixel is to be told by its hue, too.
std::uint8_t lifted(double light) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::sqrt(std::clamp(light, 0.0, 1.0))));
}

}  // namespace

std::vector<std::uint8_t> assignment_picture(const CompiledSlices& compiled, Side side,
                                             std::span<const glm::dvec3> slice_colours) {
  const FrameImages& images = compiled.images;
  const auto pixels = static_cast<std::size_t>(images.width_px) * static_cast<std::size_t>(images.height_px);
  std::vector<glm::dvec3> light(pixels, glm::dvec3(0.0));
  const double full = (1 << compiled.settings.bits) - 1;
  for (std::size_t i = 0; i < compiled.settings.images.size(); ++i) {
    const ImageSpec& spec = compiled.settings.images[i];
    const bool own = static_cast<std::size_t>(spec.eye) == index_of(side) && spec.slice >= 0 &&
                     static_cast<std::size_t>(spec.slice) < slice_colours.size();
    if (!own) continue;
    const glm::dvec3 colour = slice_colours[static_cast<std::size_t>(spec.slice)] / full;
    for (std::size_t p = 0; p < pixels; ++p)
      light[p] += colour * double(brightest(images.image(i), p, images.channels));
  }
  std::vector<std::uint8_t> rgb(pixels * 3);
  for (std::size_t p = 0; p < pixels; ++p) {
    for (int c = 0; c < 3; ++c) rgb[p * 3 + static_cast<std::size_t>(c)] = lifted(light[p][c]);
  }
  return rgb;
}

std::vector<std::uint8_t> difference_picture(std::span<const std::uint8_t> with, std::span<const std::uint8_t> without,
                                             int channels) {
  constexpr std::array<double, 3> more{1.0, 0.7, 0.25}, less{0.3, 0.6, 1.0};
  const std::size_t pixels = std::min(with.size(), without.size()) / static_cast<std::size_t>(channels);
  std::vector<std::uint8_t> rgb(pixels * 3);
  for (std::size_t p = 0; p < pixels; ++p) {
    const int change = brightest(with, p, channels) - brightest(without, p, channels);
    for (std::size_t c = 0; c < 3; ++c) {
      const double shade = change > 0 ? more[c] * change : -less[c] * change;
      rgb[p * 3 + c] = static_cast<std::uint8_t>(std::lround(shade));
    }
  }
  return rgb;
}

}  // namespace focalstage
