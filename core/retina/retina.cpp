#include "core/retina/retina.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/optics/vergence.h"
#include "core/retina/blur.h"
#include "core/retina/input_rules.h"
#include "core/retina/sight_at.h"
#include "core/retina/slice_light.h"
#include "core/retina/slice_maps.h"

namespace focalstage {
namespace {

constexpr int least_margin_px = 8;
constexpr int most_factor = 16;

const Fault cancelled{"retina.cancelled", "", "stopped before the picture was done", ""};

/// The range of blur radii of a picture.
struct Radii {
  float least_px = 0.0f;
  float most_px = 0.0f;
};

/// How the view turns vergences at the pupil into blur.
struct Focus {
  float at_pupil_d = 0.0f;
  float px_per_d = 0.0f;  ///< radius: half the pupil over the size of a pixel in the tangent plane

  explicit Focus(const RetinaInput& input, const RetinaView& view)
      : at_pupil_d(static_cast<float>(vergence_at_pupil_d(view.focus_d, input.lens_to_pupil_m))),
        px_per_d(static_cast<float>(0.5 * view.pupil_m / grid_of(view, 0).step.x)) {}

  float radius_px(float vergence_d) const {
    return std::min(BlurLayers::most_radius_px, px_per_d * std::abs(vergence_d - at_pupil_d));
  }

  Radii radii(const std::vector<const SliceMap*>& maps) const {
    Radii all{BlurLayers::most_radius_px, 0.0f};
    for (const SliceMap* map : maps) {
      if (!map->any) continue;
      const float low_px = radius_px(map->lowest_vergence_d), high_px = radius_px(map->highest_vergence_d);
      const bool sharp = map->lowest_vergence_d <= at_pupil_d && at_pupil_d <= map->highest_vergence_d;
      all.least_px = sharp ? 0.0f : std::min({all.least_px, low_px, high_px});
      all.most_px = std::max({all.most_px, low_px, high_px});
    }
    all.least_px = std::min(all.least_px, all.most_px);
    return all;
  }
};

std::vector<double> powers_of(const RetinaInput& input) {
  std::vector<double> powers_d;
  for (const RetinaSlice& slice : input.slices) powers_d.push_back(slice.power_d);
  return powers_d;
}

/// Light of every slice that reaches the grid, at the size at which the grid sees it.
std::vector<SliceLight> lights_of(const RetinaInput& input, const std::vector<const SliceMap*>& maps,
                                  const std::stop_token& stop) {
  const auto light_of_code = light_of_codes(input.bits, input.gamma);
  std::vector<SliceLight> lights(input.slices.size());
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (!maps[i]->any) continue;
    const int factor = static_cast<int>(std::clamp(maps[i]->footprint_px + 0.5, 1.0, double{most_factor}));
    lights[i] = slice_light(input.slices[i].codes, input.projector.width_px, input.projector.height_px, input.channels,
                            factor, light_of_code, stop);
  }
  return lights;
}

template <int channels>
void add_row(const SliceMap& map, const SliceLight& light, const Focus& focus, int row, BlurLayers& layers) {
  const LightSampler<channels> sampler(light);
  const SliceSpot* spots = &map.spots[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.grid.width_px)];
  for (int column = 0; column < map.grid.width_px; ++column) {
    const SliceSpot& spot = spots[column];
    if (!spot.lit()) continue;
    const std::array<float, channels> seen = sampler.at(spot.x_px, spot.y_px);
    float sum = 0.0f;
    for (const float one : seen) sum += one;
    if (!(sum > 0.0f)) continue;
    layers.add<channels>(column, row, BlurLayers::share(focus.radius_px(spot.vergence_d)), seen.data());
  }
}

RetinaImage image_of(const std::vector<float>& planes, const LookGrid& grid, int margin_px, const RetinaView& view,
                     int channels) {
  RetinaImage image{view.width_px, view.height_px, {}};
  const auto width = static_cast<std::size_t>(grid.width_px);
  const std::size_t plane = width * static_cast<std::size_t>(grid.height_px);
  image.rgb.resize(static_cast<std::size_t>(view.width_px) * static_cast<std::size_t>(view.height_px) * 3);
  float* to = image.rgb.data();
  for (int y = 0; y < view.height_px; ++y) {
    const float* from = &planes[static_cast<std::size_t>(y + margin_px) * width + static_cast<std::size_t>(margin_px)];
    for (int x = 0; x < view.width_px; ++x, ++from) {
      for (std::size_t c = 0; c < 3; ++c) *to++ = channels == 3 ? from[c * plane] : *from;
    }
  }
  return image;
}

}  // namespace

struct Retina::State {
  explicit State(int threads) : arena(threads > 0 ? threads : tbb::task_arena::automatic) {}

  Result<RetinaImage> view(const RetinaInput& input, const RetinaView& view, const std::stop_token& stop);
  Result<std::optional<RetinaSight>> look_at(const RetinaInput& input, const RetinaView& view, const glm::dvec2& look,
                                             const std::stop_token& stop);

  tbb::task_arena arena;
  SliceMaps maps;
  int margin_px = least_margin_px;  ///< light from outside the picture blurs into it; follows the blur
};

Result<RetinaImage> Retina::State::view(const RetinaInput& input, const RetinaView& view, const std::stop_token& stop) {
  const Focus focus(input, view);
  const std::vector<double> powers_d = powers_of(input);
  std::vector<const SliceMap*> slices;
  Radii radii;
  for (bool wide_enough = false; !wide_enough;) {
    slices = maps.of(input, view, margin_px, powers_d, stop);
    if (stop.stop_requested()) return cancelled;
    radii = focus.radii(slices);
    wide_enough = radii.most_px <= static_cast<float>(margin_px);
    while (static_cast<float>(margin_px) < radii.most_px) margin_px *= 2;
  }
  const int margin = margin_px;
  while (margin_px > least_margin_px && radii.most_px < static_cast<float>(margin_px) / 4.0f) margin_px /= 2;
  const std::vector<SliceLight> lights = lights_of(input, slices, stop);
  const LookGrid grid = grid_of(view, margin);
  BlurLayers layers(grid.width_px, grid.height_px, input.channels, radii.least_px, radii.most_px);
  tbb::parallel_for(0, grid.height_px, [&](int row) {
    if (stop.stop_requested()) return;
    for (std::size_t i = 0; i < slices.size(); ++i) {
      if (lights[i].any) (input.channels == 1 ? add_row<1> : add_row<3>)(*slices[i], lights[i], focus, row, layers);
    }
  });
  const std::vector<float> planes = layers.blurred(stop);
  if (stop.stop_requested()) return cancelled;
  return image_of(planes, grid, margin, view, input.channels);
}

Result<std::optional<RetinaSight>> Retina::State::look_at(const RetinaInput& input, const RetinaView& view,
                                                          const glm::dvec2& look, const std::stop_token& stop) {
  const glm::dvec2 pixel = pixel_of_look(view, look);
  const bool inside = pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < view.width_px && pixel.y < view.height_px;
  if (!inside) return std::optional<RetinaSight>();
  std::vector<double> powers_d = powers_of(input);
  powers_d.push_back(0.0);  // the bare surface
  const std::vector<const SliceMap*> slices = maps.of(input, view, margin_px, powers_d, stop);
  if (stop.stop_requested()) return cancelled;
  const std::vector<SliceLight> lights = lights_of(input, slices, stop);
  if (stop.stop_requested()) return cancelled;
  return sight_at(slices, lights, eye_of(input, view), static_cast<int>(pixel.x) + margin_px,
                  static_cast<int>(pixel.y) + margin_px);
}

Retina::Retina(int threads) : state_(std::make_unique<State>(threads)) {}
Retina::~Retina() = default;
Retina::Retina(Retina&&) noexcept = default;
Retina& Retina::operator=(Retina&&) noexcept = default;

Result<RetinaImage> Retina::view(const RetinaInput& input, const RetinaView& view, std::stop_token stop) {
  if (Status fits = check_retina(input, view); !fits) return fits.fault();
  return state_->arena.execute([&] { return state_->view(input, view, stop); });
}

Result<std::optional<RetinaSight>> Retina::look_at(const RetinaInput& input, const RetinaView& view,
                                                   const glm::dvec2& look, std::stop_token stop) {
  if (Status fits = check_retina(input, view); !fits) return fits.fault();
  return state_->arena.execute([&] { return state_->look_at(input, view, look, stop); });
}

}  // namespace focalstage
