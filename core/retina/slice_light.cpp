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
template <int channels>
void add_row(const std::uint8_t* codes, int width_px, int factor, const std::array<float, 256>& light, float* sums) {
  for (int x = 0; x < width_px; x += factor) {
    const int count = std::min(width_px - x, factor);
    for (int c = 0; c < channels; ++c) {
      float sum = 0.0f;
      for (int i = 0; i < count; ++i) sum += light[codes[i * channels + c]];
      sums[c] += sum;
    }
    codes += count * channels;
    sums += channels;
  }
}

void repeat_edges(SliceLight& light) {
  const auto channels = static_cast<std::size_t>(light.channels);
  const std::size_t stride = static_cast<std::size_t>(light.width) * channels;
  const auto row = [&](int y) { return light.values.data() + static_cast<std::size_t>(y) * stride; };
  for (int y = 1; y + 1 < light.height; ++y) {
    std::copy_n(row(y) + channels, channels, row(y));
    std::copy_n(row(y) + stride - 2 * channels, channels, row(y) + stride - channels);
  }
  std::copy_n(row(1), stride, row(0));
  std::copy_n(row(light.height - 2), stride, row(light.height - 1));
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
  light.width = (width_px + factor - 1) / factor + 2;
  light.height = (height_px + factor - 1) / factor + 2;
  light.channels = channels;
  light.factor = factor;
  const auto stride = static_cast<std::size_t>(light.width) * static_cast<std::size_t>(channels);
  const auto code_stride = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(channels);
  light.values.assign(stride * static_cast<std::size_t>(light.height), 0.0f);
  std::vector<std::uint8_t> lit(static_cast<std::size_t>(light.height), 0);
  tbb::parallel_for(1, light.height - 1, [&](int row) {
    if (stop.stop_requested()) return;
    float* sums = &light.values[static_cast<std::size_t>(row) * stride + static_cast<std::size_t>(channels)];
    const int begin = (row - 1) * factor, end = std::min(height_px, begin + factor);
    for (int y = begin; y < end; ++y) {
      const std::uint8_t* from = codes.data() + static_cast<std::size_t>(y) * code_stride;
      if (dark(from, code_stride)) continue;
      lit[static_cast<std::size_t>(row)] = 1;
      (channels == 1 ? add_row<1> : add_row<3>)(from, width_px, factor, light_of_code, sums);
    }
    if (lit[static_cast<std::size_t>(row)] == 0) return;
    for (int left = 0; left < width_px; left += factor) {
      const float share = 1.0f / static_cast<float>(std::min(width_px - left, factor) * (end - begin));
      for (int c = 0; c < channels; ++c) *sums++ *= share;
    }
  });
  light.any = std::any_of(lit.begin(), lit.end(), [](std::uint8_t row) { return row != 0; });
  if (light.any) repeat_edges(light);
  return light;
}

}  // namespace focalstage
