#include "core/retina/retina.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/retina/blur.h"
#include "core/retina/exposure_lights.h"
#include "core/retina/focus.h"
#include "core/retina/lens_rim.h"
#include "core/retina/passes.h"
#include "core/retina/sight_at.h"
#include "core/retina/slice_light.h"
#include "core/retina/slice_maps.h"

namespace focalstage {
namespace {

/// Margins are multiples of what the widest blur is shrunk by, so that the picture does not depend on how wide a margin
/// an earlier one needed.
constexpr int least_margin_px = 16;

const Fault cancelled{"retina.cancelled", "", "stopped before the picture was done", ""};

/// The range of blur radii of a picture.
struct Radii {
  float least_px = 0.0f;
  float most_px = 0.0f;
};

/// What stands between maps and picture: everything a row needs.
struct Work {
  const std::vector<Pass>& passes;
  const std::vector<const SliceMap*>& maps;         ///< one per pass
  const std::vector<const ExposureLight*>& lights;  ///< one per exposure; null: not seen
  const std::array<float, 256>& light_of_code;
  const RetinaInput& input;
  const Focus& focus;
  const LensRim& rim;
};

Radii radii_of(const Focus& focus, const std::vector<const SliceMap*>& maps) {
  Radii all{BlurLayers::most_radius_px, 0.0f};
  for (const SliceMap* map : maps) {
    if (!map->any) continue;
    for (int channel = 0; channel < focus.channels(); ++channel) {
      const float low_px = focus.radius_px(map->lowest_vergence_d, channel);
      const float high_px = focus.radius_px(map->highest_vergence_d, channel);
      const bool sharp = focus.between(map->lowest_vergence_d, map->highest_vergence_d, channel);
      all.least_px = std::min(all.least_px, sharp ? focus.least_px() : std::min(low_px, high_px));
      all.most_px = std::max({all.most_px, low_px, high_px});
    }
  }
  all.least_px = std::min(all.least_px, all.most_px);
  return all;
}

std::vector<double> powers_of(const std::vector<Pass>& passes) {
  std::vector<double> powers_d;
  for (const Pass& pass : passes) powers_d.push_back(pass.power_d);
  return powers_d;
}

/// Reads an exposure where the projector is as sharp as a spot says.
template <int channels>
class ExposureSampler {
 public:
  explicit ExposureSampler(const ExposureLight& light) : radii_px_(light.radii_px) {
    for (const SliceLight& level : light.levels) levels_.emplace_back(level);
  }

  std::array<float, channels> at(const SliceSpot& spot) const {
    if (levels_.size() == 1 || spot.spread_px <= 0.0f) return levels_.front().at(spot.x_px, spot.y_px);
    std::size_t upper = 1;
    while (upper + 1 < levels_.size() && radii_px_[upper] < spot.spread_px) ++upper;
    const float low = radii_px_[upper - 1], high = radii_px_[upper];
    const float share = std::min(1.0f, (spot.spread_px * spot.spread_px - low * low) / (high * high - low * low));
    std::array<float, channels> light = levels_[upper - 1].at(spot.x_px, spot.y_px);
    const std::array<float, channels> other = levels_[upper].at(spot.x_px, spot.y_px);
    for (std::size_t c = 0; c < channels; ++c) light[c] += share * (other[c] - light[c]);
    return light;
  }

 private:
  std::vector<LightSampler<channels>> levels_;
  const std::vector<float>& radii_px_;
};

/// One pass on its way into the layers: all channels alike, or each by its own colour's focus.
template <int channels>
class PassPainter {
 public:
  PassPainter(const Work& work, std::size_t pass, BlurLayers& layers)
      : work_(work),
        map_(*work.maps[pass]),
        whole_(*work.lights[work.passes[pass].exposure]),
        part_(work.input.exposures[work.passes[pass].exposure].codes, work.input.projector.width_px,
              work.light_of_code),
        share_(work.passes[pass].share),
        layers_(layers) {}

  void row(int row) {
    const SliceSpot* spots = &map_.spots[static_cast<std::size_t>(row) * static_cast<std::size_t>(map_.grid.width_px)];
    auto edge = map_.edges[static_cast<std::size_t>(row)].begin();
    const auto edges_end = map_.edges[static_cast<std::size_t>(row)].end();
    for (int column = 0; column < map_.grid.width_px; ++column) {
      if (edge == edges_end || static_cast<int>(edge->column) != column) {
        if (spots[column].lit()) add(column, row, spots[column], whole_.at(spots[column]), share_);
        continue;
      }
      for (const SliceSpot& part : edge->spots) {
        if (!part.lit()) continue;
        const bool sharp = part.spread_px <= 0.0f;
        add(column, row, part, sharp ? part_.at(part.x_px, part.y_px) : whole_.at(part),
            share_ / static_cast<float>(edge->spots.size()));
      }
      ++edge;
    }
  }

 private:
  void add(int column, int row, const SliceSpot& spot, std::array<float, channels> seen, float share) {
    float sum = 0.0f;
    for (const float one : seen) sum += one;
    if (!(sum > 0.0f)) return;
    const float open = share * work_.rim.open_share(map_.grid.look(column, row), spot.vergence_d);
    for (float& one : seen) one *= open;
    if (work_.focus.channels() == 1) {
      layers_.add<channels>(column, row, BlurLayers::share(work_.focus.radius_px(spot.vergence_d, 0)), seen.data());
      return;
    }
    for (int c = 0; c < 3; ++c) {
      const BlurShare blur = BlurLayers::share(work_.focus.radius_px(spot.vergence_d, c));
      layers_.add_channel(column, row, blur, c, seen[channels == 3 ? static_cast<std::size_t>(c) : 0]);
    }
  }

  const Work& work_;
  const SliceMap& map_;
  ExposureSampler<channels> whole_;
  CodeSampler<channels> part_;
  float share_;
  BlurLayers& layers_;
};

/// One row of all passes.
template <int channels>
void paint_row(const Work& work, int row, BlurLayers& layers) {
  for (std::size_t pass = 0; pass < work.passes.size(); ++pass) {
    const ExposureLight* light = work.lights[work.passes[pass].exposure];
    if (light && light->any()) PassPainter<channels>(work, pass, layers).row(row);
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
  Result<DrivenFocus> driven_focus(const RetinaInput& input, const RetinaView& view, const std::stop_token& stop);
  Result<std::optional<RetinaSight>> look_at(const RetinaInput& input, const RetinaView& view, const glm::dvec2& look,
                                             const std::stop_token& stop);

  tbb::task_arena arena;
  SliceMaps maps;
  ExposureLights exposures;
  int margin_px = least_margin_px;  ///< light from outside the picture blurs into it; follows the blur
};

Result<RetinaImage> Retina::State::view(const RetinaInput& input, const RetinaView& view, const std::stop_token& stop) {
  const Focus focus(input, view);
  const LensRim rim(input, view);
  const std::vector<Pass> passes = passes_of(input, view);
  std::vector<const SliceMap*> seen;
  Radii radii;
  for (bool wide_enough = false; !wide_enough;) {
    seen = maps.of(input, view, margin_px, powers_of(passes), stop);
    if (stop.stop_requested()) return cancelled;
    radii = radii_of(focus, seen);
    wide_enough = radii.most_px <= static_cast<float>(margin_px);
    while (static_cast<float>(margin_px) < radii.most_px) margin_px *= 2;
  }
  const int margin = margin_px;
  while (margin_px > least_margin_px && radii.most_px < static_cast<float>(margin_px) / 4.0f) margin_px /= 2;
  const std::vector<const ExposureLight*> lights = exposures.of(input, passes, seen, stop);
  if (stop.stop_requested()) return cancelled;
  const LookGrid grid = grid_of(view, margin);
  const int channels = focus.channels() == 3 ? 3 : input.channels;
  BlurLayers layers(grid.width_px, grid.height_px, channels, radii.least_px, radii.most_px);
  const auto light_of_code = light_of_codes(input.bits, input.gamma);
  const Work work{passes, seen, lights, light_of_code, input, focus, rim};
  tbb::parallel_for(0, grid.height_px, [&](int row) {
    if (!stop.stop_requested()) (input.channels == 1 ? paint_row<1> : paint_row<3>)(work, row, layers);
  });
  const std::vector<float> planes = layers.blurred(stop);
  if (stop.stop_requested()) return cancelled;
  return image_of(planes, grid, margin, view, channels);
}

namespace {

/// Sums over the exposures of one pixel.
struct FocusSum {
  double luminance = 0.0;
  double vergence_d = 0.0;
  double square_d2 = 0.0;

  void add(double light, double own_d) {
    luminance += light;
    vergence_d += light * own_d;
    square_d2 += light * own_d * own_d;
  }
};

double luminance_of(const SliceLight& light, const SliceSpot& spot, int channels) {
  if (channels == 1) return LightSampler<1>(light).at(spot.x_px, spot.y_px)[0];
  const std::array<float, 3> rgb = LightSampler<3>(light).at(spot.x_px, spot.y_px);
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

void put(const FocusSum& sum, std::size_t pixel, DrivenFocus& focus) {
  focus.luminance[pixel] = static_cast<float>(sum.luminance);
  if (!(sum.luminance > 0.0)) return;
  const double mean_d = sum.vergence_d / sum.luminance;
  focus.vergence_d[pixel] = static_cast<float>(mean_d);
  focus.spread_d[pixel] = static_cast<float>(std::sqrt(std::max(0.0, sum.square_d2 / sum.luminance - mean_d * mean_d)));
}

}  // namespace

Result<DrivenFocus> Retina::State::driven_focus(const RetinaInput& input, const RetinaView& view,
                                                const std::stop_token& stop) {
  const std::vector<Pass> passes = passes_of(input, view);
  const std::vector<const SliceMap*> seen = maps.of(input, view, margin_px, powers_of(passes), stop);
  if (stop.stop_requested()) return cancelled;
  const std::vector<const ExposureLight*> lights = exposures.of(input, passes, seen, stop);
  if (stop.stop_requested()) return cancelled;
  const LensRim rim(input, view);
  const auto pixels = static_cast<std::size_t>(view.width_px) * static_cast<std::size_t>(view.height_px);
  DrivenFocus focus{view.width_px, view.height_px, std::vector<float>(pixels, 0.0f),
                    std::vector<float>(pixels, SliceSpot::none), std::vector<float>(pixels, SliceSpot::none)};
  const LookGrid grid = grid_of(view, margin_px);
  tbb::parallel_for(0, view.height_px, [&](int y) {
    for (int x = 0; x < view.width_px && !stop.stop_requested(); ++x) {
      FocusSum sum;
      const int column = x + margin_px, row = y + margin_px;
      for (std::size_t i = 0; i < passes.size(); ++i) {
        const ExposureLight* light = lights[passes[i].exposure];
        const SliceSpot& spot = seen[i]->spots[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width_px) +
                                               static_cast<std::size_t>(column)];
        if (!light || !light->any() || !spot.lit()) continue;
        const double open = double{passes[i].share} * rim.open_share(grid.look(column, row), spot.vergence_d);
        sum.add(open * luminance_of(light->levels.front(), spot, input.channels),
                vergence_at_lens_d(spot.vergence_d, input.lens_to_pupil_m));
      }
      put(sum, static_cast<std::size_t>(y) * static_cast<std::size_t>(view.width_px) + static_cast<std::size_t>(x),
          focus);
    }
  });
  if (stop.stop_requested()) return cancelled;
  return focus;
}

Result<std::optional<RetinaSight>> Retina::State::look_at(const RetinaInput& input, const RetinaView& view,
                                                          const glm::dvec2& look, const std::stop_token& stop) {
  const glm::dvec2 pixel = pixel_of_look(view, look);
  const bool inside = pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < view.width_px && pixel.y < view.height_px;
  if (!inside) return std::optional<RetinaSight>();
  const std::vector<Pass> passes = passes_of(input, view);
  std::vector<double> powers_d = powers_of(passes);
  powers_d.push_back(0.0);  // the bare surface
  const std::vector<const SliceMap*> seen = maps.of(input, view, margin_px, powers_d, stop);
  if (stop.stop_requested()) return cancelled;
  const std::vector<const ExposureLight*> lights = exposures.of(input, passes, seen, stop);
  if (stop.stop_requested()) return cancelled;
  std::vector<SeenPass> lit;
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const ExposureLight* light = lights[passes[i].exposure];
    if (light && light->any()) lit.push_back({seen[i], &light->levels.front(), passes[i].share});
  }
  return sight_at(lit, *seen.back(), eye_of(input, view), static_cast<int>(pixel.x) + margin_px,
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

Result<DrivenFocus> Retina::driven_focus(const RetinaInput& input, const RetinaView& view, std::stop_token stop) {
  if (Status fits = check_retina(input, view); !fits) return fits.fault();
  return state_->arena.execute([&] { return state_->driven_focus(input, view, stop); });
}

Result<std::optional<RetinaSight>> Retina::look_at(const RetinaInput& input, const RetinaView& view,
                                                   const glm::dvec2& look, std::stop_token stop) {
  if (Status fits = check_retina(input, view); !fits) return fits.fault();
  return state_->arena.execute([&] { return state_->look_at(input, view, look, stop); });
}

}  // namespace focalstage
