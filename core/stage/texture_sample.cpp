#include "core/stage/texture_sample.h"

#include <cmath>
#include <vector>

namespace focalstage {
namespace {

/// IEC 61966-2-1.
double linear_from_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// The light of every number that so many bits can hold.
std::vector<double> light_table(std::size_t count, ColorSpace space) {
  std::vector<double> light(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    light[i] = space == ColorSpace::srgb ? linear_from_srgb(share) : share;
  }
  return light;
}

const double* light_of(const Texture& texture) {
  static const std::vector<double> srgb8 = light_table(256, ColorSpace::srgb);
  static const std::vector<double> srgb16 = light_table(65536, ColorSpace::srgb);
  static const std::vector<double> linear8 = light_table(256, ColorSpace::linear);
  static const std::vector<double> linear16 = light_table(65536, ColorSpace::linear);
  if (texture.color_space == ColorSpace::srgb) return (texture.is_deep() ? srgb16 : srgb8).data();
  return (texture.is_deep() ? linear16 : linear8).data();
}

int wrapped(long long texel, int count, Wrap wrap) {
  if (wrap == Wrap::clamp) return static_cast<int>(texel < 0 ? 0 : texel >= count ? count - 1 : texel);
  const long long period = wrap == Wrap::repeat ? count : 2LL * count;
  const long long in_period = (texel % period + period) % period;
  return static_cast<int>(in_period < count ? in_period : period - 1 - in_period);
}

/// Where a texel's four numbers stand.
std::size_t place(const Texture& texture, int column, int row) {
  return (static_cast<std::size_t>(row) * static_cast<std::size_t>(texture.width_px) +
          static_cast<std::size_t>(column)) *
         4;
}

struct ColorOfTexel {
  const Texture& texture;
  const double* light;

  glm::dvec3 operator()(int column, int row) const {
    const std::size_t at = place(texture, column, row);
    if (texture.is_deep()) return of(&texture.rgba16[at]);
    return of(&texture.rgba[at]);
  }
  template <class Number>
  glm::dvec3 of(const Number* rgb) const {
    return {light[rgb[0]], light[rgb[1]], light[rgb[2]]};
  }
};

struct AlphaOfTexel {
  const Texture& texture;

  double operator()(int column, int row) const {
    const std::size_t at = place(texture, column, row) + 3;
    return texture.is_deep() ? texture.rgba16[at] / 65535.0 : texture.rgba[at] / 255.0;
  }
};

/// The value at `uv` of what `texel` says of each pixel.
template <class Texel>
auto sampled(const Texture& texture, const glm::dvec2& uv, const Texel& texel) -> decltype(texel(0, 0)) {
  const double half = texture.magnify == Magnify::linear ? 0.5 : 0.0;
  const double x = uv.x * texture.width_px - half;
  const double y = (1.0 - uv.y) * texture.height_px - half;  // rows are stored from the top
  if (!std::isfinite(x) || !std::isfinite(y) || std::abs(x) > 1e15 || std::abs(y) > 1e15) return {};
  const auto left = static_cast<long long>(std::floor(x));
  const auto top = static_cast<long long>(std::floor(y));
  const int c0 = wrapped(left, texture.width_px, texture.wrap_u);
  const int r0 = wrapped(top, texture.height_px, texture.wrap_v);
  if (texture.magnify == Magnify::nearest) return texel(c0, r0);
  const double right_share = x - static_cast<double>(left);
  const double lower_share = y - static_cast<double>(top);
  const int c1 = wrapped(left + 1, texture.width_px, texture.wrap_u);
  const int r1 = wrapped(top + 1, texture.height_px, texture.wrap_v);
  const auto upper = texel(c0, r0) * (1.0 - right_share) + texel(c1, r0) * right_share;
  const auto lower = texel(c0, r1) * (1.0 - right_share) + texel(c1, r1) * right_share;
  return upper * (1.0 - lower_share) + lower * lower_share;
}

}  // namespace

glm::dvec3 sample_texture(const Texture& texture, const glm::dvec2& uv) {
  return sampled(texture, uv, ColorOfTexel{texture, light_of(texture)});
}

double sample_alpha(const Texture& texture, const glm::dvec2& uv) {
  return sampled(texture, uv, AlphaOfTexel{texture});
}

}  // namespace focalstage
