#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include <glm/vec2.hpp>

#include "core/base/luminance.h"

namespace focalstage {

/// Linear light of each projector code, black taken for dark: (code / (2^bits - 1))^gamma or by the measured
/// `transfer`, the encoder's inverse.
std::array<float, 256> light_of_codes(int bits, double gamma, const std::vector<double>& transfer = {});

/// One image of the projector in linear light, so averaged that reading between its pixels gives the mean over the
/// rectangle that a retinal pixel sees of it: each projector pixel is a square of even light. A frame of one pixel
/// repeats the edge.
struct SliceLight {
  int width = 0;  ///< with the frame
  int height = 0;
  int channels = 1;
  glm::vec2 seen_px{1.0f};    ///< sides of that rectangle
  std::vector<float> values;  ///< [row][column][channel]
  bool any = false;
};

SliceLight slice_light(std::span<const std::uint8_t> codes, int width_px, int height_px, int channels,
                       const glm::dvec2& seen_px, const std::array<float, 256>& light_of_code,
                       const std::stop_token& stop);

/// The same out of focus: every pixel spread over a disc.
SliceLight spread_light(const SliceLight& light, double radius_px);

/// Reads a slice's light at places of the image.
template <int channels>
class LightSampler {
 public:
  explicit LightSampler(const SliceLight& light)
      : values_(light.values.data()),
        stride_(static_cast<std::size_t>(light.width) * channels),
        steep_{1.0f / std::min(1.0f, light.seen_px.x), 1.0f / std::min(1.0f, light.seen_px.y)} {}

  /// At a place within the image, in the projector's pixels. Between two pixels' centres the light runs from one to the
  /// other over as much of the way as the rectangle is wide.
  std::array<float, channels> at(float x_px, float y_px) const {
    const float x = x_px + 0.5f, y = y_px + 0.5f;  // the frame
    const auto column = static_cast<std::int32_t>(x), row = static_cast<std::int32_t>(y);
    const float right = share(x - static_cast<float>(column), steep_.x);
    const float down = share(y - static_cast<float>(row), steep_.y);
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
  static float share(float between, float steep) { return std::clamp((between - 0.5f) * steep + 0.5f, 0.0f, 1.0f); }

  const float* values_;
  std::size_t stride_;
  glm::vec2 steep_;
};

/// Luminance (Rec. 709) at a place within the image.
inline double luminance_at(const SliceLight& light, float x_px, float y_px) {
  if (light.channels == 1) return LightSampler<1>(light).at(x_px, y_px)[0];
  const std::array<float, 3> rgb = LightSampler<3>(light).at(x_px, y_px);
  return luminance<double>(rgb[0], rgb[1], rgb[2]);
}

/// Reads the codes themselves: for the sixteenths of a pixel, each so small that the projector's pixels are large
/// beside it.
template <int channels>
class CodeSampler {
 public:
  CodeSampler(std::span<const std::uint8_t> codes, int width_px, const std::array<float, 256>& light_of_code)
      : codes_(codes.data()), width_(static_cast<std::size_t>(width_px)), light_(light_of_code) {}

  /// At a place within the image.
  std::array<float, channels> at(float x_px, float y_px) const {
    const std::size_t pixel = static_cast<std::size_t>(y_px) * width_ + static_cast<std::size_t>(x_px);
    std::array<float, channels> light;
    for (std::size_t c = 0; c < channels; ++c) light[c] = light_[codes_[pixel * channels + c]];
    return light;
  }

 private:
  const std::uint8_t* codes_;
  std::size_t width_;
  const std::array<float, 256>& light_;
};

}  // namespace focalstage
