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

/// Steps of a third at most, so that a mixture of two discs still looks like one. All radii are quarters.
constexpr std::array<Layer, 25> layers{
    {{0.0f, 1},  {0.5f, 1},  {0.75f, 1}, {1.0f, 1},  {1.25f, 1},  {1.5f, 1},   {2.0f, 1},   {2.5f, 1},  {3.0f, 1},
     {4.0f, 1},  {5.0f, 2},  {6.0f, 2},  {8.0f, 2},  {10.0f, 2},  {12.0f, 2},  {16.0f, 2},  {20.0f, 4}, {24.0f, 4},
     {32.0f, 4}, {40.0f, 8}, {48.0f, 8}, {64.0f, 8}, {80.0f, 16}, {96.0f, 16}, {128.0f, 16}}};

/// The disc of a layer at its own size. A disc of radius r spreads light by r^2 / 4 in each direction (its variance).
/// Sharing a pixel out between the coarse ones around it spreads it by factor^2 / 6 + 1/12 in the mean, reading between
/// them by as much again, and the coarse pixel by (factor^2 - 1) / 12 more than a pixel does.
Disc make_disc(const Layer& layer) {
  const double factor = layer.factor, ratio = layer.radius_px / factor, part = 1.0 / (factor * factor);
  if (layer.factor == 1) return disc_of(layer.radius_px);
  return disc_of(std::sqrt(ratio * ratio - (4.0 + 2.0 * part) / 3.0 - (1.0 - part) / 3.0));
}

const std::array<Disc, layers.size()>& discs() {
  static const std::array<Disc, layers.size()> made = [] {
    std::array<Disc, layers.size()> all;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = make_disc(layers[i]);
    return all;
  }();
  return made;
}

/// A pixel's place between two coarse ones.
struct Between {
  int low = 0;
  float high_share = 0.0f;
};

std::vector<Between> places_of(int size_px, int factor, int frame) {
  std::vector<Between> places;
  for (int i = 0; i < size_px; ++i) {
    const float place = (static_cast<float>(i) + 0.5f) / static_cast<float>(factor) - 0.5f + static_cast<float>(frame);
    const int low = static_cast<int>(place);
    places.push_back({low, place - static_cast<float>(low)});
  }
  return places;
}

/// A plane at 1 / factor of its size, with a frame of dark pixels about it. Light goes in and comes out by shares
/// between neighbours, which keeps its sum and its centre.
struct CoarsePlane {
  int factor, width, height;
  std::vector<Between> columns, rows;  ///< of the fine pixels
  std::vector<float> values;

  CoarsePlane(int width_px, int height_px, int by, int frame)
      : factor(by),
        width((width_px + by - 1) / by + 2 * frame),
        height((height_px + by - 1) / by + 2 * frame),
        columns(places_of(width_px, by, frame)),
        rows(places_of(height_px, by, frame)),
        values(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0f) {}

  float* row(int y) { return &values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)]; }
  const float* row(int y) const { return &values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)]; }

  void take(const float* plane) {
    const float share = 1.0f / static_cast<float>(factor * factor);
    for (const Between& y : rows) {
      float *const upper = row(y.low), *const lower = row(y.low + 1);
      const float below = share * y.high_share, above = share - below;
      for (const Between& x : columns) {
        const float light = *plane++;
        if (light == 0.0f) continue;
        const float right = light * x.high_share, left = light - right;
        upper[x.low] += above * left;
        upper[x.low + 1] += above * right;
        lower[x.low] += below * left;
        lower[x.low + 1] += below * right;
      }
    }
  }

  void add_to(float* plane) const {
    tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t y) {
      const float *const a = row(rows[y].low), *const b = row(rows[y].low + 1);
      float* onto = plane + y * columns.size();
      for (const Between& x : columns) {
        const float above = a[x.low] + x.high_share * (a[x.low + 1] - a[x.low]);
        const float under = b[x.low] + x.high_share * (b[x.low + 1] - b[x.low]);
        *onto++ += above + rows[y].high_share * (under - above);
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
  coarse.take(plane);
  CoarsePlane spread(width_px, height_px, layer.factor, disc.reach_px + 1);
  add_spread(disc, coarse.values.data(), coarse.width, coarse.height, spread.values.data());
  spread.add_to(onto);
}

}  // namespace

const std::array<BlurLayers::Step, 513> BlurLayers::steps = make_steps();

std::array<BlurLayers::Step, 513> BlurLayers::make_steps() {
  std::array<Step, 513> made{};
  std::size_t layer = 0;
  for (std::size_t quarter = 0; quarter < made.size(); ++quarter) {
    while (layer + 2 < layers.size() && layers[layer + 1].radius_px * 4.0f <= static_cast<float>(quarter)) ++layer;
    const float low = layers[layer].radius_px, high = layers[layer + 1].radius_px;
    made[quarter] = {static_cast<int>(layer), low * low, 1.0f / (high * high - low * low)};
  }
  return made;
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
