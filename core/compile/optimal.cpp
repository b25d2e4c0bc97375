#include "core/compile/optimal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "core/compile/stack_target.h"
#include "core/compile/wanted_depth.h"

namespace focalstage {
namespace {

/// What one eye's frame may cost, in tiles that show few triangles: half a second or so of one processor. A raster of
/// 1024 x 768 pixels has 12288 tiles; a scene of some cards or bodies, a few hundred near depth edges.
constexpr double most_cost = 2500.0;
constexpr double triangles_of_equal_cost = 250.0;  ///< that cost as much as the tile itself

/// What a tile's target costs, by the triangles in the cells around it.
double cost_of(const EyeView& all, const LookTile& tile) {
  const CellGrid& grid = all.cells.grid;
  const auto x = static_cast<float>(tile.look.x);
  const auto y = static_cast<float>(tile.look.y);
  std::uint32_t triangles = 0;
  for (int row = row_of(grid, y) - 1; row <= row_of(grid, y) + 1; ++row) {
    if (row < 0 || row >= grid.rows) continue;
    const int first = row * grid.columns + std::max(0, column_of(grid, x) - 1);
    const int last = row * grid.columns + std::min(grid.columns - 1, column_of(grid, x) + 1);
    triangles += all.cells.begin[static_cast<std::size_t>(last) + 1] - all.cells.begin[static_cast<std::size_t>(first)];
  }
  return 1.0 + triangles / triangles_of_equal_cost;
}

using Channels = std::array<StackField, 3>;

/// One eye's linear images and targets, as the solver wants them.
struct Fields {
  Channels shown;  ///< [tile][slice], as linear filtering would have it
  StackField most;
  Channels target;
};

std::size_t image_of(const FrameRun& run, Side side, std::size_t slice) {
  const ImageEye eye = side == Side::left ? ImageEye::left : ImageEye::right;
  const auto& images = run.settings->images;
  const auto found = std::find_if(images.begin(), images.end(), [&](const ImageSpec& image) {
    return image.eye == eye && image.slice == static_cast<int>(slice);
  });
  return static_cast<std::size_t>(found - images.begin());
}

void fill_slice(const FrameRun& run, Side side, const StackPlan& plan, std::size_t slot, std::size_t n,
                Fields& fields) {
  const StackTile& tile = plan.tiles[slot];
  const ImageSpec& image = run.settings->images[image_of(run, side, plan.slices[n])];
  ImageSpec content = image;
  content.kind = ImageKind::content;
  TileLight light;
  thread_local std::vector<ObjectTally> uncounted;
  uncounted.assign(run.stage->objects.size(), {});
  light_of_tile(run, content, tile.column, tile.row, light, uncounted);
  const std::size_t first = (slot * plan.slice_count() + n) * tile_samples;
  for (int c = 0; c < run.slice.channels; ++c) {
    StackField& shown = fields.shown[static_cast<std::size_t>(c)];
    for (std::size_t i = 0; i < tile_samples; ++i) shown[first + i] = light.channel[c][i];
  }
  if (image.kind == ImageKind::content) return;
  ImageSpec surface = image;
  surface.kind = ImageKind::surface_light;
  light_of_tile(run, surface, tile.column, tile.row, light, uncounted);
  for (std::size_t i = 0; i < tile_samples; ++i) fields.most[first + i] = std::max(0.0f, 1.0f - light.channel[0][i]);
}

Fields make_fields(const FrameRun& run, Side side, const PixelLooks& looks, const EyeView& all, const StackPlan& plan,
                   const std::stop_token& stop) {
  const std::size_t tiles = plan.tiles.size();
  const std::size_t stack = plan.focus_count() * tile_samples;
  Fields fields;
  for (int c = 0; c < run.slice.channels; ++c) {
    fields.shown[static_cast<std::size_t>(c)].assign(tiles * plan.slice_count() * tile_samples, 0.0f);
    fields.target[static_cast<std::size_t>(c)].assign(tiles * stack, 0.0f);
  }
  fields.most.assign(tiles * plan.slice_count() * tile_samples, 1.0f);
  const StackTarget target(all, looks, plan, run.slices, run.slice.channels, *run.slice.kernel);
  tbb::parallel_for(std::size_t{0}, tiles, [&](std::size_t slot) {
    if (stop.stop_requested()) return;
    for (std::size_t n = 0; n < plan.slice_count(); ++n) fill_slice(run, side, plan, slot, n, fields);
    thread_local std::vector<float> seen;
    target.tile(slot, seen);
    for (std::size_t c = 0; c < static_cast<std::size_t>(run.slice.channels); ++c) {
      std::copy_n(&seen[c * stack], stack, &fields.target[c][slot * stack]);
    }
  });
  return fields;
}

/// Changes are against light of at most 1; what linear filtering wanted above that goes where a pixel changes at all.
void add_excess(const StackField& shown, StackField& change) {
  for (std::size_t i = 0; i < change.size(); ++i) {
    if (change[i] != 0.0f && shown[i] > 1.0f) change[i] -= shown[i] - 1.0f;
  }
}

StackSolution solve_channel(const FrameRun& run, const StackPlan& plan, const Fields& fields, std::size_t channel,
                            const std::stop_token& stop) {
  StackProblem problem{fields.shown[channel], fields.most, fields.target[channel]};
  for (float& light : problem.linear) light = std::min(light, 1.0f);
  StackSolution solution = solve_stack(plan, problem, *run.slice.kernel, stop);
  add_excess(fields.shown[channel], solution.change);
  return solution;
}

}  // namespace

const float* OptimalChange::of(std::size_t tile, std::size_t slice, std::size_t channel) const {
  if (plan.empty() || plan.slot_of[tile] < 0) return nullptr;
  const auto found = std::find(plan.slices.begin(), plan.slices.end(), slice);
  if (found == plan.slices.end()) return nullptr;
  const auto n = static_cast<std::size_t>(found - plan.slices.begin());
  return &change[channel][(static_cast<std::size_t>(plan.slot_of[tile]) * plan.slice_count() + n) * tile_samples];
}

OptimalChange optimal_change(const FrameRun& run, Side side, const PixelLooks& looks, const EyeView& all,
                             std::stop_token stop) {
  OptimalChange out;
  const double lens_to_pupil_m = run.settings->lens_to_pupil_m;
  const WantedDepth wanted = wanted_depth(*run.views[side], looks, run.slices, *run.slice.kernel);
  if (stop.stop_requested()) return out;
  out.plan = stack_plan(wanted, looks, run.slices, lens_to_pupil_m,
                        {most_cost, [&](std::size_t tile) { return cost_of(all, looks.tiles[tile]); }});
  if (out.plan.empty() || stop.stop_requested()) return out;
  const Fields fields = make_fields(run, side, looks, all, out.plan, stop);
  out.measure.tiles = out.plan.asked_tiles;
  out.measure.left_tiles = out.plan.left_tiles;
  const auto channels = static_cast<std::size_t>(run.slice.channels);
  StackSolution solution;
  for (std::size_t c = 0; c < channels && !stop.stop_requested(); ++c) {
    const bool again = c > 0 && fields.shown[c] == fields.shown[c - 1] && fields.target[c] == fields.target[c - 1];
    if (!again) solution = solve_channel(run, out.plan, fields, c, stop);  // gray in colour is solved once
    out.change[c] = solution.change;
    out.measure.accepted_tiles = std::max<std::uint64_t>(out.measure.accepted_tiles, solution.accepted_tiles);
    out.measure.linear_error += solution.linear.sum;
    out.measure.optimal_error += solution.optimal.sum;
    out.measure.values += solution.linear.count;
  }
  return out;
}

void add_change(const OptimalChange& change, std::size_t tile, std::size_t slice, int channels, TileLight& light) {
  for (int c = 0; c < channels; ++c) {
    const float* const more = change.of(tile, slice, static_cast<std::size_t>(c));
    if (more == nullptr) return;
    for (int i = 0; i < tile_samples; ++i) {
      if (more[i] == 0.0f) continue;
      light.channel[c][i] = std::max(0.0f, light.channel[c][i] + more[i]);
      light.any = true;
    }
  }
}

}  // namespace focalstage
