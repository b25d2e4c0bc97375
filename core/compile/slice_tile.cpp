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

/// Counts lit samples; most neighbours belong to the same object, so it keeps one tally at hand.
class Counter {
 public:
  Counter(const SliceRule& rule, std::vector<ObjectTally>& tallies)
      : lowest_d_(static_cast<float>(rule.lowest_d())),
        highest_d_(static_cast<float>(rule.highest_d())),
        tallies_(tallies) {}
  ~Counter() { put_back(); }

  void count(std::uint32_t owner, bool pinned, float wanted_d) {
    if (owner != owner_) {
      put_back();
      owner_ = owner;
    }
    ++now_.samples;
    const float beyond_d = pinned ? 0.0f : std::max(lowest_d_ - wanted_d, wanted_d - highest_d_);
    if (beyond_d > worst_d_) worst_d_ = beyond_d;
    if (beyond_d > limit_d) ++now_.beyond;
  }

 private:
  static constexpr float limit_d = 0.3f;

  void put_back() {
    if (now_.samples == 0) return;
    ObjectTally& sum = tallies_[owner_];
    sum.samples += now_.samples;
    sum.beyond += now_.beyond;
    sum.worst_beyond_d = std::max<double>(sum.worst_beyond_d, worst_d_);
    now_ = {};
    worst_d_ = 0.0f;
  }

  float lowest_d_;
  float highest_d_;
  std::vector<ObjectTally>& tallies_;
  std::uint32_t owner_ = 0;
  ObjectTally now_;
  float worst_d_ = 0.0f;
};

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

  Counter counter(*run.rule, tallies);
  for (int i = 0; i < tile_samples; ++i) {
    if (!(weights.weight[i] > 0.0f)) continue;
    const ViewTriangle& triangle = met(view, nearest, i);
    const glm::dvec3 color = view.shaders[triangle.drawable].color(
        triangle, tile.origin_x + static_cast<double>(looks.x[i]), tile.origin_y + static_cast<double>(looks.y[i]));
    add(run, color, weights.weight[i] * run.share, i, light);
    light.any = true;
    counter.count(view.owner[triangle.drawable], view.rules[triangle.drawable].slice >= 0, weights.wanted_d[i]);
  }
}

}  // namespace focalstage
