#include <array>
#include <cmath>

#include "core/compile/shading.h"

namespace focalstage {
namespace {

/// IEC 61966-2-1.
double linear_from_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

const std::array<double, 256>& linear_table() {
  static const std::array<double, 256> table = [] {
    std::array<double, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = linear_from_srgb(static_cast<double>(i) / 255.0);
    return linear;
  }();
  return table;
}

int wrapped(long long texel, int count, Wrap wrap) {
  if (wrap == Wrap::clamp) return static_cast<int>(texel < 0 ? 0 : texel >= count ? count - 1 : texel);
  const long long period = wrap == Wrap::repeat ? count : 2LL * count;
  const long long in_period = (texel % period + period) % period;
  return static_cast<int>(in_period < count ? in_period : period - 1 - in_period);
}

glm::dvec3 texel(const Texture& texture, int column, int row) {
  const std::size_t at =
      (static_cast<std::size_t>(row) * static_cast<std::size_t>(texture.width_px) + static_cast<std::size_t>(column)) *
      4;
  const auto& linear = linear_table();
  return {linear[texture.rgba[at]], linear[texture.rgba[at + 1]], linear[texture.rgba[at + 2]]};
}

}  // namespace

glm::dvec3 sample_texture(const Texture& texture, const glm::dvec2& uv) {
  const double half = texture.magnify == Magnify::linear ? 0.5 : 0.0;
  const double x = uv.x * texture.width_px - half;
  const double y = (1.0 - uv.y) * texture.height_px - half;  // rows are stored from the top
  if (!std::isfinite(x) || !std::isfinite(y) || std::abs(x) > 1e15 || std::abs(y) > 1e15) return glm::dvec3(0.0);
  const auto left = static_cast<long long>(std::floor(x));
  const auto top = static_cast<long long>(std::floor(y));
  if (texture.magnify == Magnify::nearest) {
    return texel(texture, wrapped(left, texture.width_px, texture.wrap_u),
                 wrapped(top, texture.height_px, texture.wrap_v));
  }
  const double right_share = x - static_cast<double>(left);
  const double lower_share = y - static_cast<double>(top);
  const int c0 = wrapped(left, texture.width_px, texture.wrap_u);
  const int c1 = wrapped(left + 1, texture.width_px, texture.wrap_u);
  const int r0 = wrapped(top, texture.height_px, texture.wrap_v);
  const int r1 = wrapped(top + 1, texture.height_px, texture.wrap_v);
  const glm::dvec3 upper = texel(texture, c0, r0) * (1.0 - right_share) + texel(texture, c1, r0) * right_share;
  const glm::dvec3 lower = texel(texture, c0, r1) * (1.0 - right_share) + texel(texture, c1, r1) * right_share;
  return upper * (1.0 - lower_share) + lower * lower_share;
}

}  // namespace focalstage
