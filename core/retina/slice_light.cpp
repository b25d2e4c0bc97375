#include "core/retina/slice_light.h"

#include <cmath>
#include <cstring>

#include <tbb/parallel_for.h>

#include "core/optics/transfer.h"
#include "core/retina/disc.h"

namespace focalstage {
namespace {

constexpr double widest_px = 64.0;

bool dark(const std::uint8_t* codes, std::size_t count) {
  return codes[0] == 0 && std::memcmp(codes, codes + 1, count - 1) == 0;
}

/// The mean over `width_px` about a pixel's centre, as shares of that pixel and those to each side: those at the ends
/// count by the part that lies inside. One pixel and less: itself, and the sampler does the rest.
struct Window {
  int reach = 0;
  float inner = 1.0f;
  float outer = 0.0f;  ///< of the two at the ends

  explicit Window(double width_px) {
    const double width = std::min(width_px, widest_px);
    if (width <= 1.0) return;
    reach = static_cast<int>(std::ceil((width - 1.0) / 2.0));
    inner = static_cast<float>(1.0 / width);
    outer = static_cast<float>(((width - 1.0) / 2.0 - (reach - 1)) / width);
  }
  float share(int away) const { return std::abs(away) == reach && reach > 0 ? outer : inner; }
};

/// Where the rows and columns of one plane lie: those outside repeat the edge.
struct Plane {
  std::size_t width, height, channels;
  std::size_t stride() const { return width * channels; }
};

void add_scaled(const float* from, float share, std::size_t count, float* onto) {
  for (std::size_t i = 0; i < count; ++i) onto[i] += share * from[i];
}

/// Along a row, whose ends are repeated by `reach` pixels in `padded`.
void average_row(const float* row, const Plane& plane, const Window& window, std::vector<float>& padded, float* to) {
  if (window.reach == 0) {
    std::copy_n(row, plane.stride(), to);
    return;
  }
  const auto reach = static_cast<std::size_t>(window.reach);
  padded.resize(plane.stride() + 2 * reach * plane.channels);
  for (std::size_t i = 0; i < reach; ++i) {
    std::copy_n(row, plane.channels, &padded[i * plane.channels]);
    std::copy_n(row + plane.stride() - plane.channels, plane.channels,
                &padded[plane.stride() + (reach + i) * plane.channels]);
  }
  std::copy_n(row, plane.stride(), &padded[reach * plane.channels]);
  std::fill_n(to, plane.stride(), 0.0f);
  for (int away = -window.reach; away <= window.reach; ++away) {
    const std::size_t begin = static_cast<std::size_t>(window.reach + away) * plane.channels;
    add_scaled(&padded[begin], window.share(away), plane.stride(), to);
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

/// Rows of linear light averaged along themselves; rows without light are left empty and not marked.
struct AveragedRows {
  std::vector<float> values;
  std::vector<std::uint8_t> lit;
};

AveragedRows averaged_rows(std::span<const std::uint8_t> codes, const Plane& plane, const Window& window,
                           const std::array<float, 256>& light_of_code, const std::stop_token& stop) {
  AveragedRows rows;
  rows.values.resize(plane.stride() * plane.height);
  rows.lit.assign(plane.height, 0);
  tbb::parallel_for(std::size_t{0}, plane.height, [&](std::size_t y) {
    const std::uint8_t* from = codes.data() + y * plane.stride();
    if (stop.stop_requested() || dark(from, plane.stride())) return;
    rows.lit[y] = 1;
    std::vector<float> light(plane.stride()), padded;
    for (std::size_t i = 0; i < plane.stride(); ++i) light[i] = light_of_code[from[i]];
    average_row(light.data(), plane, window, padded, &rows.values[y * plane.stride()]);
  });
  return rows;
}

}  // namespace

std::array<float, 256> light_of_codes(int bits, double gamma, const std::vector<double>& transfer) {
  std::array<float, 256> light{};
  for (int code = 0; code < 256; ++code)
    light[static_cast<std::size_t>(code)] = static_cast<float>(share_of_code(code, bits, gamma, transfer));
  return light;
}

SliceLight slice_light(std::span<const std::uint8_t> codes, int width_px, int height_px, int channels,
                       const glm::dvec2& seen_px, const std::array<float, 256>& light_of_code,
                       const std::stop_token& stop) {
  const Plane plane{static_cast<std::size_t>(width_px), static_cast<std::size_t>(height_px),
                    static_cast<std::size_t>(channels)};
  const Window across(seen_px.x), down(seen_px.y);
  const AveragedRows rows = averaged_rows(codes, plane, across, light_of_code, stop);
  SliceLight light;
  light.width = width_px + 2;
  light.height = height_px + 2;
  light.channels = channels;
  light.seen_px = glm::vec2(seen_px);
  light.any = std::any_of(rows.lit.begin(), rows.lit.end(), [](std::uint8_t row) { return row != 0; });
  if (!light.any || stop.stop_requested()) return light;
  const std::size_t stride = plane.stride() + 2 * plane.channels;
  light.values.assign(stride * (plane.height + 2), 0.0f);
  tbb::parallel_for(0, height_px, [&](int y) {
    if (stop.stop_requested()) return;
    float* const to = &light.values[static_cast<std::size_t>(y + 1) * stride + plane.channels];
    for (int away = -down.reach; away <= down.reach; ++away) {
      const auto from = static_cast<std::size_t>(std::clamp(y + away, 0, height_px - 1));
      if (rows.lit[from] != 0) add_scaled(&rows.values[from * plane.stride()], down.share(away), plane.stride(), to);
    }
  });
  repeat_edges(light);
  return light;
}

SliceLight spread_light(const SliceLight& light, double radius_px) {
  if (!light.any || radius_px <= 0.0) return light;
  SliceLight spread = light;
  const auto channels = static_cast<std::size_t>(light.channels);
  const Disc disc = disc_of(std::min(radius_px, widest_px));
  const std::size_t pixels = light.values.size() / channels;
  for (std::size_t c = 0; c < channels; ++c) {
    std::vector<float> plane(pixels), sum(pixels, 0.0f);
    for (std::size_t i = 0; i < pixels; ++i) plane[i] = light.values[i * channels + c];
    add_spread(disc, plane.data(), light.width, light.height, sum.data());
    for (std::size_t i = 0; i < pixels; ++i) spread.values[i * channels + c] = sum[i];
  }
  return spread;
}

}  // namespace focalstage
