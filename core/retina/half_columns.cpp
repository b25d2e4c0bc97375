#include "core/retina/half_columns.h"

#include <algorithm>
#include <utility>

namespace focalstage {
namespace {

std::vector<std::uint8_t> cut_in_two(std::span<const std::uint8_t> codes, const ProjectorModel& projector,
                                     std::size_t channels) {
  const auto width = static_cast<std::size_t>(projector.width_px),
             height = static_cast<std::size_t>(projector.height_px);
  const std::size_t stride = (2 * width + 1) * channels;
  std::vector<std::uint8_t> halves(stride * height, 0);
  for (std::size_t y = 0; y < height; ++y) {
    std::uint8_t* to = &halves[y * stride + y % 2 * channels];
    const std::uint8_t* from = &codes[y * width * channels];
    for (std::size_t x = 0; x < width; ++x, from += channels) {
      to = std::copy_n(from, channels, to);
      to = std::copy_n(from, channels, to);
    }
  }
  return halves;
}

}  // namespace

HalfColumns::HalfColumns(const RetinaInput& input) : input_(input) {
  codes_.reserve(input.exposures.size());
  for (RetinaExposure& exposure : input_.exposures) {
    codes_.push_back(cut_in_two(exposure.codes, input.projector, static_cast<std::size_t>(input.channels)));
    exposure.codes = codes_.back();
  }
  ProjectorModel& projector = input_.projector;
  projector.layout = PixelLayout::square;
  projector.width_px = 2 * projector.width_px + 1;
  projector.focal_px.x *= 2.0;
  projector.centre_px.x *= 2.0;
  input_.projector_focus.depth_of_field_d /= 2.0;  // the same disc has twice as many of these pixels
}

}  // namespace focalstage
