#include "core/compile/slice_tile.h"

#include <algorithm>
#include <optional>

#include "core/base/luminance.h"
#include "core/compile/cuts.h"

namespace focalstage {
namespace {

const ViewTriangle& met(const EyeView& view, const TileNearest& nearest, int i) {
  return view.view.triangles[static_cast<std::size_t>(nearest.triangle[i])];
}

void fill_wants(const EyeView& view, const TileNearest& nearest, TileWants& wants) {
  const VergenceRule& first = view.rules.front();
  std::fill_n(wants.gain, tile_samples, first.gain);
  std::fill_n(wants.offset_d, tile_samples, first.offset_d);
  if (view.one_rule) return;
  for (int i = 0; i < tile_samples; ++i) {
    if (nearest.triangle[i] < 0) continue;
    const VergenceRule& rule = view.rules[met(view, nearest, i).drawable];
    wants.gain[i] = rule.gain;
    wants.offset_d[i] = rule.offset_d;
  }
}

/// Objects pinned to a slice have all their light in it.
void pin(const EyeView& view, const TileNearest& nearest, int slice_index, TileWeights& weights) {
  if (view.one_rule) return;
  for (int i = 0; i < tile_samples; ++i) {
    if (nearest.triangle[i] < 0) continue;
    const VergenceRule& rule = view.rules[met(view, nearest, i).drawable];
    if (rule.slice >= 0) weights.weight[i] = rule.slice == slice_index ? 1.0f : 0.0f;
  }
}

void add(const SliceRun& run, const glm::dvec3& color, float weight, int i, TileLight& light) {
  if (run.channels == 1) {
    light.channel[0][i] += weight * static_cast<float>(luminance(color.r, color.g, color.b));
    return;
  }
  for (int c = 0; c < 3; ++c) light.channel[c][i] += weight * static_cast<float>(color[c]);
}

/// How far samples want beyond the outermost slices, counted per object.
class Counter {
 public:
  explicit Counter(const SliceRule& rule)
      : lowest_d_(static_cast<float>(rule.lowest_d())), highest_d_(static_cast<float>(rule.highest_d())) {}

  /// Samples that want powers from `from_d` to `to_d`; `each` tells them apart where some may be beyond the limit.
  template <class Each>
  void count(int samples, float from_d, float to_d, ObjectTally& tally, const Each& each) const {
    tally.samples += static_cast<std::uint64_t>(samples);
    const float below_d = std::max(0.0f, lowest_d_ - from_d);
    const float above_d = std::max(0.0f, to_d - highest_d_);
    tally.worst_below_d = std::max<double>(tally.worst_below_d, below_d);
    tally.worst_above_d = std::max<double>(tally.worst_above_d, above_d);
    tally.worst_beyond_d = std::max(tally.worst_below_d, tally.worst_above_d);
    if (below_d > limit_d || above_d > limit_d)
      each([&](float wanted_d) { tally.beyond += is_beyond(wanted_d) ? 1 : 0; });
  }

 private:
  static constexpr float limit_d = 0.3f;

  bool is_beyond(float wanted_d) const { return lowest_d_ - wanted_d > limit_d || wanted_d - highest_d_ > limit_d; }

  float lowest_d_;
  float highest_d_;
};

/// What one tile and slice came to, before it is coloured.
struct Shown {
  const SliceRun& run;
  const EyeView& view;
  const EyeTile& tile;
  const TileLooks& looks;
  const TileNearest& nearest;
  const TileWeights& weights;
};

std::uint32_t drawable_at(const EyeView& view, std::int32_t index) {
  return static_cast<std::uint32_t>(std::upper_bound(view.first.begin(), view.first.end(), index) - view.first.begin() -
                                    1);
}

float level(const SliceRun& run, const glm::dvec3& color, int channel) {
  return static_cast<float>(run.channels == 1 ? luminance(color.r, color.g, color.b) : color[channel]);
}

void color_each(const Shown& shown, TileLight& light) {
  for (int i = 0; i < tile_samples; ++i) {
    if (!(shown.weights.weight[i] > 0.0f)) continue;
    const ViewTriangle& triangle = met(shown.view, shown.nearest, i);
    const glm::dvec3 color = shown.view.shaders[triangle.drawable].color(
        triangle, shown.tile.origin_x + static_cast<double>(shown.looks.x[i]),
        shown.tile.origin_y + static_cast<double>(shown.looks.y[i]));
    add(shown.run, color, shown.weights.weight[i] * shown.run.share, i, light);
  }
}

/// All samples belong to one drawable: one colour, or squares of one triangle, go by the vector.
void color_drawable(const Shown& shown, const TileLit& lit, std::uint32_t drawable, TileLight& light) {
  const Kernel& kernel = *shown.run.kernel;
  const Shader& shader = shown.view.shaders[drawable];
  if (const glm::dvec3* color = shader.uniform()) {
    for (int c = 0; c < shown.run.channels; ++c) {
      kernel.add_even(shown.weights, shown.run.share, level(shown.run, *color, c), light.channel[c]);
    }
    return;
  }
  const ViewTriangle& triangle = shown.view.view.triangles[static_cast<std::size_t>(lit.lowest_triangle)];
  const auto planes = lit.lowest_triangle == lit.highest_triangle ? shader.checker_planes(triangle) : std::nullopt;
  if (!planes) return color_each(shown, light);
  for (int c = 0; c < shown.run.channels; ++c) {
    kernel.add_checker(*planes, shown.looks, shown.tile.origin_x, shown.tile.origin_y, shown.weights, shown.run.share,
                       level(shown.run, shader.finish().a, c), level(shown.run, shader.finish().b, c),
                       light.channel[c]);
  }
}

void count_each(const Shown& shown, const Counter& counter, std::vector<ObjectTally>& tallies) {
  for (int i = 0; i < tile_samples; ++i) {
    if (!(shown.weights.weight[i] > 0.0f)) continue;
    const std::uint32_t drawable = met(shown.view, shown.nearest, i).drawable;
    ObjectTally& tally = tallies[shown.view.owner[drawable]];
    if (shown.view.rules[drawable].slice >= 0) {
      ++tally.samples;
      continue;
    }
    const float wanted_d = shown.weights.wanted_d[i];
    counter.count(1, wanted_d, wanted_d, tally, [&](const auto& one) { one(wanted_d); });
  }
}

void count_drawable(const Shown& shown, const TileLit& lit, std::uint32_t drawable, const Counter& counter,
                    std::vector<ObjectTally>& tallies) {
  ObjectTally& tally = tallies[shown.view.owner[drawable]];
  if (shown.view.rules[drawable].slice >= 0) {
    tally.samples += static_cast<std::uint64_t>(lit.count);
    return;
  }
  counter.count(lit.count, lit.lowest_d, lit.highest_d, tally, [&](const auto& one) {
    for (int i = 0; i < tile_samples; ++i) {
      if (shown.weights.weight[i] > 0.0f) one(shown.weights.wanted_d[i]);
    }
  });
}

}  // namespace

void slice_tile(const SliceRun& run, const EyeView& view, const EyeTile& tile, const SliceSetup& slice,
                std::size_t slice_index, TileLight& light, std::vector<ObjectTally>& tallies) {
  const auto lens_to_pupil_m = static_cast<float>(view.lens_to_pupil_m);
  TileLooks looks;
  run.kernel->place(tile.hits, tile.origin_x, tile.origin_y, slice.bend, lens_to_pupil_m, looks);
  TileNearest nearest;
  run.kernel->cover(kernel_view(view.view, view.cells), looks, tile.origin_x, tile.origin_y, nearest);
  pass_cuts(view, looks, tile.origin_x, tile.origin_y, nearest);
  TileWants wants;
  fill_wants(view, nearest, wants);
  TileWeights weights;
  run.kernel->weigh(tile.hits, nearest, wants, slice.band, slice.bend, lens_to_pupil_m, weights);
  if (slice.empty) std::fill_n(weights.weight, tile_samples, 0.0f);
  pin(view, nearest, static_cast<int>(slice_index), weights);

  const TileLit lit = run.kernel->lit(nearest, weights);
  if (lit.count == 0) return;
  light.any = true;
  if (run.keeps_weights) run.kernel->add_even(weights, run.share, 1.0f, light.weight);
  const Shown shown{run, view, tile, looks, nearest, weights};
  const Counter counter(*run.rule);
  const std::uint32_t drawable = drawable_at(view, lit.lowest_triangle);
  if (drawable == drawable_at(view, lit.highest_triangle)) {
    color_drawable(shown, lit, drawable, light);
    count_drawable(shown, lit, drawable, counter, tallies);
  } else {
    color_each(shown, light);
    count_each(shown, counter, tallies);
  }
}

}  // namespace focalstage
