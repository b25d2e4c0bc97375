#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

namespace focalstage {

/// Linear light of each projector code: (code / (2^bits - 1))^gamma, the encoder's inverse.
std::array<float, 256> light_of_codes(int bits, double gamma);

/// One image of the projector in linear light, averaged over squares of `factor` pixels so that one bilinear sample
/// stands for what a retinal pixel sees of it. A frame of one square repeats the edge.
struct SliceLight {
  int width = 0;  ///< in squares, with the frame; the last of a row or column may be cut off by the image's edge
  int height = 0;
  int channels = 1;
  int factor = 1;
  std::vector<float> values;  ///< [row][column][channel]
  bool any = false;
};

SliceLight slice_light(std::span<const std::uint8_t> codes, int width_px, int height_px, int channels, int factor,
                       const std::array<float, 256>& light_of_code, const std::stop_token& stop);

/// Reads a slice's light at places of the image.
template <int channels>
class LightSampler {
 public:
  explicit LightSampler(const SliceLight& light)
      : values_(light.values.data()),
        stride_(static_cast<std::size_t>(light.width) * channels),
        per_square_(1.0f / static_cast<float>(light.factor)) {}

  /// At a place within the image, in the projector's pixels.
  std::array<float, channels> at(float x_px, float y_px) const {
    const float x = x_px * per_square_ + 0.5f, y = y_px * per_square_ + 0.5f;  // a half for the frame
    const auto column = static_cast<std::int32_t>(x), row = static_cast<std::int32_t>(y);
    const float right = x - static_cast<float>(column), down = y - static_cast<float>(row);
    const float* upper =
        values_ + static_cast<std::size_t>(row) * stride_ + static_cast<std::size_t>(column) * channels;
    const float* lower = upper + stride_;
    std::array<float, channels> light;
    for (std::size_t c = 0; c < channels; ++c, ++upper, ++lower) {
      const float above = upper[0] + right * (upper[channels] - upper[0]);
      const float below = lower[0] + right * (lower[channels] - lower[0]);
      light[c] = above + down * (below - above);
    }
    return light;
  }

 private:
  const float* values_;
  std::size_t stride_;
  float per_square_;
};

}  // namespace focalstage
