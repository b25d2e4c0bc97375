#include "core/retina/slice_light.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <tbb/parallel_for.h>

namespace focalstage {
namespace {

bool dark(const std::uint8_t* codes, std::size_t count) {
  return codes[0] == 0 && std::memcmp(codes, codes + 1, count - 1) == 0;
}

/// Sums of light over the squares that a row of codes crosses.
void add_row(const std::uint8_t* codes, int width_px, int channels, int factor, const std::array<float, 256>& light,
             float* sums) {
  for (int x = 0; x < width_px; x += factor) {
    const int end = std::min(width_px, x + factor);
    for (int i = x; i < end; ++i) {
      for (int c = 0; c < channels; ++c) sums[c] += light[*codes++];
    }
    sums += channels;
  }
}

}  // namespace

std::array<float, 256> light_of_codes(int bits, double gamma) {
  std::array<float, 256> light{};
  const int highest = (1 << bits) - 1;
  for (int code = 0; code < 256; ++code) {
    light[static_cast<std::size_t>(code)] =
        static_cast<float>(std::pow(static_cast<double>(std::min(code, highest)) / highest, gamma));
  }
  return light;
}

SliceLight slice_light(std::span<const std::uint8_t> codes, int width_px, int height_px, int channels, int factor,
                       const std::array<float, 256>& light_of_code, const std::stop_token& stop) {
  SliceLight light;
  light.width = (width_px + factor - 1) / factor;
  light.height = (height_px + factor - 1) / factor;
  light.channels = channels;
  light.factor = factor;
  const auto stride = static_cast<std::size_t>(light.width) * static_cast<std::size_t>(channels);
  const auto code_stride = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(channels);
  light.values.assign(stride * static_cast<std::size_t>(light.height), 0.0f);
  std::vector<std::uint8_t> lit(static_cast<std::size_t>(light.height), 0);
  tbb::parallel_for(0, light.height, [&](int row) {
    if (stop.stop_requested()) return;
    float* sums = &light.values[static_cast<std::size_t>(row) * stride];
    const int begin = row * factor, end = std::min(height_px, begin + factor);
    for (int y = begin; y < end; ++y) {
      const std::uint8_t* from = codes.data() + static_cast<std::size_t>(y) * code_stride;
      if (dark(from, code_stride)) continue;
      lit[static_cast<std::size_t>(row)] = 1;
      add_row(from, width_px, channels, factor, light_of_code, sums);
    }
    if (lit[static_cast<std::size_t>(row)] == 0) return;
    for (int column = 0; column < light.width; ++column) {
      const int columns = std::min(width_px, (column + 1) * factor) - column * factor;
      const float share = 1.0f / static_cast<float>(columns * (end - begin));
      for (int c = 0; c < channels; ++c) *sums++ *= share;
    }
  });
  light.any = std::any_of(lit.begin(), lit.end(), [](std::uint8_t row) { return row != 0; });
  return light;
}

}  // namespace focalstage
