#include "core/compile/slice_tile.h"

#include <algorithm>

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
    light.channel[0][i] += weight * static_cast<float>(luminance(color));
    return;
  }
  for (int c = 0; c < 3; ++c) light.channel[c][i] += weight * static_cast<float>(color[c]);
}

void tally(const SliceRun& run, bool pinned, float wanted_d, ObjectTally& out) {
  constexpr double limit_d = 0.3;
  ++out.samples;
  const double beyond_d = pinned ? 0.0 : run.rule->beyond_d(wanted_d);
  out.worst_beyond_d = std::max(out.worst_beyond_d, beyond_d);
  double& own_side_d = run.rule->is_below(wanted_d) ? out.worst_below_d : out.worst_above_d;
  own_side_d = std::max(own_side_d, beyond_d);
  if (beyond_d > limit_d) ++out.beyond;
}

}  // namespace

void slice_tile(const SliceRun& run, const EyeView& view, const EyeTile& tile, const SliceSetup& slice,
                std::size_t slice_index, TileLight& light, std::vector<ObjectTally>& tallies) {
  const auto lens_to_pupil_m = static_cast<float>(view.lens_to_pupil_m);
  TileLooks looks;
  run.kernel->place(tile.hits, tile.origin_x, tile.origin_y, slice.bend, lens_to_pupil_m, looks);
  TileNearest nearest;
  run.kernel->cover(kernel_view(view.view, view.cells), looks, tile.origin_x, tile.origin_y, nearest);
  TileWants wants;
  fill_wants(view, nearest, wants);
  TileWeights weights;
  run.kernel->weigh(tile.hits, nearest, wants, slice.band, slice.bend, lens_to_pupil_m, weights);
  if (slice.empty) std::fill_n(weights.weight, tile_samples, 0.0f);
  pin(view, nearest, static_cast<int>(slice_index), weights);

  for (int i = 0; i < tile_samples; ++i) {
    if (!(weights.weight[i] > 0.0f)) continue;
    const ViewTriangle& triangle = met(view, nearest, i);
    const glm::dvec3 color = view.shaders[triangle.drawable].color(
        triangle, tile.origin_x + static_cast<double>(looks.x[i]), tile.origin_y + static_cast<double>(looks.y[i]));
    add(run, color, weights.weight[i] * run.share, i, light);
    light.any = true;
    tally(run, view.rules[triangle.drawable].slice >= 0, weights.wanted_d[i], tallies[view.owner[triangle.drawable]]);
  }
}

}  // namespace focalstage
