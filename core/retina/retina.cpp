#include "core/retina/retina.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/retina/blur.h"
#include "core/retina/driven_focus.h"
#include "core/retina/exposure_lights.h"
#include "core/retina/focus.h"
#include "core/retina/half_columns.h"
#include "core/retina/lens_rim.h"
#include "core/retina/pass_painter.h"
#include "core/retina/passes.h"
#include "core/retina/return_painter.h"
#include "core/retina/sight_at.h"
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

/// Of what is lit through one power, or of all that is seen.
struct Vergences {
  float lowest_d = std::numeric_limits<float>::infinity();
  float highest_d = -std::numeric_limits<float>::infinity();

  void include(const SliceSpot& spot) {
    if (!spot.seen()) return;
    lowest_d = std::min(lowest_d, spot.vergence_d);
    highest_d = std::max(highest_d, spot.vergence_d);
  }
};

Vergences vergences_of(const SliceMap& map, bool also_unlit) {
  if (!also_unlit && map.any) return {map.lowest_vergence_d, map.highest_vergence_d};
  Vergences all;
  if (!also_unlit) return all;
  for (const SliceSpot& spot : map.spots) all.include(spot);
  for (const std::vector<EdgePixel>& row : map.edges) {
    for (const EdgePixel& pixel : row) {
      for (const SliceSpot& part : pixel.spots) all.include(part);
    }
  }
  return all;
}

Radii radii_of(const Focus& focus, const std::vector<Pass>& passes, const std::vector<const SliceMap*>& maps) {
  Radii all{BlurLayers::most_radius_px, 0.0f};
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const Vergences seen = vergences_of(*maps[i], passes[i].is_ambient());
    if (!(seen.lowest_d <= seen.highest_d)) continue;
    for (int channel = 0; channel < focus.channels(); ++channel) {
      const float low_px = focus.radius_px(seen.lowest_d, channel);
      const float high_px = focus.radius_px(seen.highest_d, channel);
      const bool sharp = focus.between(seen.lowest_d, seen.highest_d, channel);
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

/// Calls `see` with an input whose pixels lie in squares.
template <class See>
auto on_squares(const RetinaInput& input, See see) {
  if (input.projector.layout == PixelLayout::square) return see(input);
  return see(HalfColumns(input).input());
}

}  // namespace

struct Retina::State {
  explicit State(int threads) : arena(threads > 0 ? threads : tbb::task_arena::automatic) {}

  Result<RetinaImage> view(const RetinaInput& input, const RetinaView& view, const std::stop_token& stop);
  Result<DrivenFocus> driven_focus(const RetinaInput& input, const RetinaView& view, const std::stop_token& stop);
  Result<std::optional<RetinaSight>> look_at(const RetinaInput& input, const RetinaView& view, const glm::dvec2& look,
                                             const std::stop_token& stop);
  std::optional<std::vector<SeenPass>> seen_passes(const RetinaInput& input, const RetinaView& view,
                                                   std::optional<double> also_d, const std::stop_token& stop);

  tbb::task_arena arena;
  SliceMaps maps;
  ExposureLights exposures;
  int margin_px = least_margin_px;  ///< light from outside the picture blurs into it; follows the blur
};

Result<RetinaImage> Retina::State::view(const RetinaInput& input, const RetinaView& view, const std::stop_token& stop) {
  const Focus focus(input, view);
  const LensRim rim(input, view);
  std::vector<Pass> passes = passes_of(input, view);
  const std::vector<Pass> ambient = ambient_passes_of(input, view);
  passes.insert(passes.end(), ambient.begin(), ambient.end());
  std::vector<const SliceMap*> seen;
  Radii radii;
  for (bool wide_enough = false; !wide_enough;) {
    seen = maps.of(input, view, margin_px, powers_of(passes), stop);
    if (stop.stop_requested()) return cancelled;
    radii = radii_of(focus, passes, seen);
    wide_enough = radii.most_px <= static_cast<float>(margin_px);
    while (static_cast<float>(margin_px) < radii.most_px) margin_px *= 2;
  }
  const int margin = margin_px;
  while (margin_px > least_margin_px && radii.most_px < static_cast<float>(margin_px) / 4.0f) margin_px /= 2;
  const std::vector<const ExposureLight*> lights = exposures.of(input, passes, seen, stop);
  if (stop.stop_requested()) return cancelled;
  const LookGrid grid = grid_of(view, margin);
  const auto light_of_code = light_of_codes(input.bits, input.gamma, input.transfer);
  const PaintWork work{passes, seen, lights, light_of_code, input, focus, rim};
  const bool returned = needs_returns(work);
  const int channels = focus.channels() == 3 || returned ? 3 : input.channels;
  BlurLayers layers(grid.width_px, grid.height_px, channels, radii.least_px, radii.most_px);
  tbb::parallel_for(0, grid.height_px, [&](int row) {
    if (!stop.stop_requested()) (returned ? paint_returned_row : paint_row)(work, row, layers);
  });
  const std::vector<float> planes = layers.blurred(stop);
  if (stop.stop_requested()) return cancelled;
  RetinaImage image = image_of(planes, grid, margin, view, channels);
  if (input.level != 1.0) {
    for (float& value : image.rgb) value *= static_cast<float>(input.level);
  }
  return image;
}

/// What is lit and seen through each power, sharp; for `also_d` too there is a map, the last one. None after a stop
/// request.
std::optional<std::vector<SeenPass>> Retina::State::seen_passes(const RetinaInput& input, const RetinaView& view,
                                                                std::optional<double> also_d,
                                                                const std::stop_token& stop) {
  const std::vector<Pass> passes = passes_of(input, view);
  std::vector<double> powers_d = powers_of(passes);
  if (also_d) powers_d.push_back(*also_d);
  const std::vector<const SliceMap*> seen = maps.of(input, view, margin_px, powers_d, stop);
  if (stop.stop_requested()) return std::nullopt;
  const std::vector<const ExposureLight*> lights = exposures.of(input, passes, seen, stop);
  if (stop.stop_requested()) return std::nullopt;
  std::vector<SeenPass> lit;
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const ExposureLight* light = lights[passes[i].exposure];
    if (light && light->any()) lit.push_back({seen[i], &light->levels.front(), passes[i].share});
  }
  if (also_d) lit.push_back({seen.back(), nullptr, 0.0f});
  return lit;
}

Result<DrivenFocus> Retina::State::driven_focus(const RetinaInput& input, const RetinaView& view,
                                                const std::stop_token& stop) {
  const auto lit = seen_passes(input, view, std::nullopt, stop);
  if (!lit) return cancelled;
  DrivenFocus focus = driven_focus_of(*lit, input, view, margin_px, stop);
  if (stop.stop_requested()) return cancelled;
  if (input.level != 1.0) {
    for (float& value : focus.luminance) value *= static_cast<float>(input.level);
  }
  return focus;
}

Result<std::optional<RetinaSight>> Retina::State::look_at(const RetinaInput& input, const RetinaView& view,
                                                          const glm::dvec2& look, const std::stop_token& stop) {
  const glm::dvec2 pixel = pixel_of_look(view, look);
  const bool inside = pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < view.width_px && pixel.y < view.height_px;
  if (!inside) return std::optional<RetinaSight>();
  auto lit = seen_passes(input, view, 0.0, stop);
  if (!lit) return cancelled;
  const SliceMap& bare = *lit->back().map;
  lit->pop_back();
  return sight_at(*lit, bare, eye_of(input, view), static_cast<int>(pixel.x) + margin_px,
                  static_cast<int>(pixel.y) + margin_px);
}

Retina::Retina(int threads) : state_(std::make_unique<State>(threads)) {}
Retina::~Retina() = default;
Retina::Retina(Retina&&) noexcept = default;
Retina& Retina::operator=(Retina&&) noexcept = default;

Result<RetinaImage> Retina::view(const RetinaInput& input, const RetinaView& view, std::stop_token stop) {
  if (Status fits = check_retina(input, view); !fits) return fits.fault();
  return state_->arena.execute(
      [&] { return on_squares(input, [&](const RetinaInput& squares) { return state_->view(squares, view, stop); }); });
}

Result<DrivenFocus> Retina::driven_focus(const RetinaInput& input, const RetinaView& view, std::stop_token stop) {
  if (Status fits = check_retina(input, view); !fits) return fits.fault();
  return state_->arena.execute([&] {
    return on_squares(input, [&](const RetinaInput& squares) { return state_->driven_focus(squares, view, stop); });
  });
}

Result<std::optional<RetinaSight>> Retina::look_at(const RetinaInput& input, const RetinaView& view,
                                                   const glm::dvec2& look, std::stop_token stop) {
  if (Status fits = check_retina(input, view); !fits) return fits.fault();
  return state_->arena.execute([&] {
    return on_squares(input, [&](const RetinaInput& squares) { return state_->look_at(squares, view, look, stop); });
  });
}

}  // namespace focalstage
