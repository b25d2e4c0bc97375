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
/// stands for what a retinal pixel sees of it.
struct SliceLight {
  int width = 0;  ///< in squares; the last of a row or column may be cut off by the image's edge
  int height = 0;
  int channels = 1;
  int factor = 1;
  std::vector<float> values;  ///< [row][column][channel]
  bool any = false;

  /// Light at a place of the image in projector pixels; clamped at the edge.
  std::array<float, 3> at(float x_px, float y_px) const;
};

SliceLight slice_light(std::span<const std::uint8_t> codes, int width_px, int height_px, int channels, int factor,
                       const std::array<float, 256>& light_of_code, const std::stop_token& stop);

inline std::array<float, 3> SliceLight::at(float x_px, float y_px) const {
  const float per_square = 1.0f / static_cast<float>(factor);
  const float x = x_px * per_square - 0.5f, y = y_px * per_square - 0.5f;
  const int left = static_cast<int>(x + 1.0f) - 1, top = static_cast<int>(y + 1.0f) - 1;  // floor: both are >= -0.5
  const float right_share = x - static_cast<float>(left), lower_share = y - static_cast<float>(top);
  const auto column = [&](int i) {
    return static_cast<std::size_t>((i < 0 ? 0 : i < width ? i : width - 1) * channels);
  };
  const auto row = [&](int i) {
    return static_cast<std::size_t>(i < 0        ? 0
                                    : i < height ? i
                                                 : height - 1) *
           static_cast<std::size_t>(width * channels);
  };
  const float* const upper = values.data() + row(top);
  const float* const lower = values.data() + row(top + 1);
  const std::size_t a = column(left), b = column(left + 1);
  std::array<float, 3> light{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
    const float above = upper[a + c] + right_share * (upper[b + c] - upper[a + c]);
    const float below = lower[a + c] + right_share * (lower[b + c] - lower[a + c]);
    light[c] = above + lower_share * (below - above);
  }
  return light;
}

}  // namespace focalstage
