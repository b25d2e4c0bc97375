#include "core/retina/blur.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "core/retina/disc.h"

namespace focalstage {
namespace {

/// A layer's radius and the share of full size at which it is blurred: 1 / factor.
struct Layer {
  float radius_px;
  int factor;
};

/// Steps of less than a third, so that a mixture of two discs still looks like one. All radii are quarters.
constexpr std::array<Layer, 25> layers{
    {{0.0f, 1},  {0.5f, 1},   {0.75f, 1},  {1.0f, 1},   {1.25f, 1},  {1.5f, 1},   {2.0f, 1},   {2.5f, 1},  {3.0f, 1},
     {4.0f, 1},  {5.0f, 2},   {6.0f, 2},   {8.0f, 2},   {10.0f, 4},  {12.0f, 4},  {16.0f, 4},  {20.0f, 8}, {24.0f, 8},
     {32.0f, 8}, {40.0f, 16}, {48.0f, 16}, {64.0f, 16}, {80.0f, 32}, {96.0f, 32}, {128.0f, 32}}};

/// The layer below each quarter of a pixel.
std::array<std::uint8_t, 513> make_below() {
  std::array<std::uint8_t, 513> below{};
  std::uint8_t layer = 0;
  for (std::size_t quarter = 0; quarter < below.size(); ++quarter) {
    while (layer + 2u < layers.size() && layers[layer + 1u].radius_px * 4.0f <= static_cast<float>(quarter)) ++layer;
    below[quarter] = layer;
  }
  return below;
}
const std::array<std::uint8_t, 513> below = make_below();

/// The disc of a layer at its own size. A disc of radius r spreads light by r^2 / 4 in each direction (its variance);
/// averaging over `factor` pixels and interpolating between the averages spread it by factor^2 / 4 together, and the
/// coarser pixel by (factor^2 - 1) / 12 more than a pixel does.
Disc make_disc(const Layer& layer) {
  const double factor = layer.factor, ratio = layer.radius_px / factor;
  if (layer.factor == 1) return disc_of(layer.radius_px);
  return disc_of(std::sqrt(ratio * ratio - 1.0 - (1.0 - 1.0 / (factor * factor)) / 3.0));
}

const std::array<Disc, layers.size()>& discs() {
  static const std::array<Disc, layers.size()> made = [] {
    std::array<Disc, layers.size()> all;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = make_disc(layers[i]);
    return all;
  }();
  return made;
}

/// A plane averaged over squares of `factor` pixels, with a frame of dark squares about it so that what spreads beyond
/// its edge is not lost at a coarse square's border.
struct CoarsePlane {
  int factor, width, height, frame;
  std::vector<float> values;

  CoarsePlane(int width_px, int height_px, int by, int reach)
      : factor(by),
        width((width_px + by - 1) / by + 2 * reach),
        height((height_px + by - 1) / by + 2 * reach),
        frame(reach),
        values(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0f) {}

  float* row(int y) { return &values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)]; }
  const float* row(int y) const { return &values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)]; }

  void average(const float* plane, int width_px, int height_px) {
    const float share = 1.0f / static_cast<float>(factor * factor);
    tbb::parallel_for(0, (height_px + factor - 1) / factor, [&](int square) {
      float* const sums = row(square + frame) + frame;
      for (int y = square * factor; y < std::min(height_px, (square + 1) * factor); ++y) {
        const float* const from = plane + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px);
        for (int x = 0; x < width_px; ++x) sums[x / factor] += share * from[x];
      }
    });
  }

  /// Adds the plane, interpolated between the squares' centres.
  void add_to(float* plane, int width_px, int height_px) const {
    const auto place = [&](int pixel) {
      return (static_cast<float>(pixel) + 0.5f) / static_cast<float>(factor) - 0.5f;
    };
    tbb::parallel_for(0, height_px, [&](int y) {
      const float down = place(y) + static_cast<float>(frame);
      const int top = static_cast<int>(down);
      const float lower = down - static_cast<float>(top);
      const float *const a = row(top), *const b = row(top + 1);
      float* const onto = plane + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px);
      for (int x = 0; x < width_px; ++x) {
        const float across = place(x) + static_cast<float>(frame);
        const int left = static_cast<int>(across);
        const float right = across - static_cast<float>(left);
        const float above = a[left] + right * (a[left + 1] - a[left]);
        const float under = b[left] + right * (b[left + 1] - b[left]);
        onto[x] += above + lower * (under - above);
      }
    });
  }
};

void add_blurred(const Layer& layer, const Disc& disc, const float* plane, int width_px, int height_px, float* onto) {
  if (layer.factor == 1) {
    add_spread(disc, plane, width_px, height_px, onto);
    return;
  }
  CoarsePlane coarse(width_px, height_px, layer.factor, disc.reach_px + 1);
  coarse.average(plane, width_px, height_px);
  CoarsePlane spread(width_px, height_px, layer.factor, disc.reach_px + 1);
  add_spread(disc, coarse.values.data(), coarse.width, coarse.height, spread.values.data());
  spread.add_to(onto, width_px, height_px);
}

}  // namespace

BlurShare BlurLayers::share(float radius_px) {
  const float radius = std::min(radius_px, most_radius_px);
  const int layer = below[static_cast<std::size_t>(radius * 4.0f)];
  const float low = layers[static_cast<std::size_t>(layer)].radius_px;
  const float high = layers[static_cast<std::size_t>(layer) + 1].radius_px;
  return {layer, (radius * radius - low * low) / (high * high - low * low)};
}

BlurLayers::BlurLayers(int width_px, int height_px, int channels, float least_px, float most_px)
    : width_(static_cast<std::size_t>(width_px)),
      height_(static_cast<std::size_t>(height_px)),
      channels_(channels),
      first_(share(least_px).layer),
      count_(share(most_px).layer + 2 - first_),
      light_(width_ * height_ * static_cast<std::size_t>(channels) * static_cast<std::size_t>(count_), 0.0f) {}

std::vector<float> BlurLayers::blurred(const std::stop_token& stop) const {
  const std::size_t plane = width_ * height_;
  std::vector<float> sum(plane * static_cast<std::size_t>(channels_), 0.0f);
  for (int i = 0; i < count_; ++i) {
    const auto layer = static_cast<std::size_t>(first_ + i);
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels_); ++c) {
      if (stop.stop_requested()) return sum;
      const float* const light = &light_[(static_cast<std::size_t>(i * channels_) + c) * plane];
      add_blurred(layers[layer], discs()[layer], light, static_cast<int>(width_), static_cast<int>(height_),
                  &sum[c * plane]);
    }
  }
  return sum;
}

}  // namespace focalstage
