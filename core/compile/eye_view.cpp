#include "core/compile/eye_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace focalstage {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

VergenceRule rule_of(const Depth& depth) {
  switch (depth.mode) {
    case DepthMode::placed:
      return {1.0f, 0.0f, -1};
    case DepthMode::fixed:
      return {0.0f, static_cast<float>(depth.vergence_d), -1};
    case DepthMode::offset:
      return {1.0f, static_cast<float>(depth.vergence_d), -1};
    case DepthMode::slice:
      return {0.0f, 0.0f, depth.index};
  }
  return {};
}

bool alike(const VergenceRule& a, const VergenceRule& b) {
  return a.gain == b.gain && a.offset_d == b.offset_d && a.slice < 0 && b.slice < 0;
}

struct Range {
  double low, high;
};

Range times(Range a, Range b) {
  const auto [low, high] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return {low, high};
}

/// Stretch - 1 over the distances of a tile; monotonic in the distance.
Range stretch_less_one(const EyeTile& tile, const SliceSetup& slice, double lens_to_pupil_m) {
  const auto at = [&](double surface_m) {
    const double bent = static_cast<double>(slice.bend) * surface_m;
    return bent / (surface_m + lens_to_pupil_m - bent);
  };
  const auto [low, high] = std::minmax({at(tile.min_surface_m), at(tile.max_surface_m)});
  constexpr double slack = 1e-6;
  return {low - slack, high + slack};
}

/// Vergence of the surface's plane along the looks of a tile: q / (1 - d_e q) with q the inverse distance from the
/// pupil.
Range surface_vergence_d(const EyeTile& tile, Range stretch, double lens_to_pupil_m) {
  const double reach = tile.max_slope * std::max(std::abs(stretch.low), std::abs(stretch.high));
  constexpr double slack_d = 1e-3;
  const auto vergence_d = [&](double q) {
    if (q <= 0.0) return 0.0;
    const double from_lens = 1.0 - lens_to_pupil_m * q;
    return from_lens > 0.0 ? q / from_lens : std::numeric_limits<double>::infinity();
  };
  return {vergence_d(tile.min_inverse_m - reach) - slack_d, vergence_d(tile.max_inverse_m + reach) + slack_d};
}

/// Everything that the eye can look at through any slice.
Box all_looks(const EyeHits& hits, const std::vector<SliceSetup>& slices, double lens_to_pupil_m) {
  Box bounds{infinity, infinity, -infinity, -infinity};
  if (slices.empty()) return bounds;
  const auto [low, high] = std::minmax_element(
      slices.begin(), slices.end(), [](const SliceSetup& a, const SliceSetup& b) { return a.bend < b.bend; });
  for (const EyeTile& tile : hits.tiles) {
    if (!tile.any) continue;
    bounds = hull(bounds, look_bounds(tile, *low, lens_to_pupil_m));
    bounds = hull(bounds, look_bounds(tile, *high, lens_to_pupil_m));
  }
  return bounds;
}

}  // namespace

std::vector<SliceSetup> slice_setups(const Slices& slices, double lens_to_pupil_m) {
  const SliceRule rule(slices.powers_d, slices.assignment);
  std::vector<SliceSetup> setups;
  for (std::size_t n = 0; n < rule.count(); ++n) {
    const SliceRule::Band& band = rule.band(n);
    SliceSetup setup;
    setup.power_d = slices.powers_d[n];
    setup.bend = slices.breathing == Breathing::off ? 0.0f : static_cast<float>(setup.power_d * lens_to_pupil_m);
    setup.from_d = static_cast<float>(band.from_d);
    setup.to_d = static_cast<float>(band.to_d);
    setup.empty = band.empty;
    setup.band = {static_cast<float>(band.power_d),
                  std::isinf(band.from_d) ? 0.0f : static_cast<float>(1.0 / (band.power_d - band.from_d)),
                  std::isinf(band.to_d) ? 0.0f : static_cast<float>(1.0 / (band.to_d - band.power_d)),
                  setup.from_d,
                  setup.to_d,
                  slices.assignment == Assignment::nearest};
    setups.push_back(setup);
  }
  return setups;
}

void look_at_objects(EyeView& out, const Stage& stage, const std::vector<ViewDrawable>& objects, const Eye& eye,
                     const EyeHits& hits, const TileGrid& grid, const std::vector<SliceSetup>& slices) {
  out.lens_to_pupil_m = eye.lens_to_pupil_m;
  out.rules.clear();
  out.shaders.clear();
  out.owner.clear();
  out.first.clear();
  out.one_rule = true;
  out.cuts = false;
  const Rigid world_from_eye = eye.eye_from_world.inverse();
  std::int32_t first = 0;
  for (const ViewDrawable& object : objects) {
    out.first.push_back(first);
    first += static_cast<std::int32_t>(object.drawable->mesh->triangles.size());
    out.rules.push_back(rule_of(stage.objects[object.owner].depth));
    out.shaders.emplace_back(*object.drawable, stage.lights, world_from_eye);
    out.owner.push_back(object.owner);
    out.cuts = out.cuts || out.shaders.back().cuts();
    out.one_rule = out.one_rule && alike(out.rules.front(), out.rules.back());
  }
  const Box bounds = all_looks(hits, slices, eye.lens_to_pupil_m);
  set_up(out.view, objects, eye.eye_from_world, nearest_seen_m(eye.lens_to_pupil_m), bounds);
  sort_into_cells(out.cells, out.view, bounds, grid.columns(), grid.rows(), out.rules, eye.lens_to_pupil_m);
  out.nothing = out.view.empty();
}

Box look_bounds(const EyeTile& tile, const SliceSetup& slice, double lens_to_pupil_m) {
  const Range less_one = stretch_less_one(tile, slice, lens_to_pupil_m);
  const Range stretch{1.0 + less_one.low, 1.0 + less_one.high};
  const Range x = times({tile.straight.min_x, tile.straight.max_x}, stretch);
  const Range y = times({tile.straight.min_y, tile.straight.max_y}, stretch);
  return {static_cast<float>(x.low), static_cast<float>(y.low), static_cast<float>(x.high), static_cast<float>(y.high)};
}

bool may_be_lit(const EyeView& view, const EyeTile& tile, const SliceSetup& slice, std::size_t slice_index) {
  if (view.nothing || !tile.any) return false;
  const Box looks = look_bounds(tile, slice, view.lens_to_pupil_m);
  const CellGrid& grid = view.cells.grid;
  CellContent content = nothing_wanted;
  const int last_column = column_of(grid, looks.max_x);
  const int last_row = row_of(grid, looks.max_y);
  for (int row = row_of(grid, looks.min_y); row <= last_row; ++row) {
    for (int column = column_of(grid, looks.min_x); column <= last_column; ++column) {
      content.add(view.cells.content[static_cast<std::size_t>(row * grid.columns + column)]);
    }
  }
  if (content.pinned_slices >> slice_index & 1) return true;
  if (!content.depth_decides || slice.empty) return false;
  const Range stretch = stretch_less_one(tile, slice, view.lens_to_pupil_m);
  const Range surface_d = surface_vergence_d(tile, stretch, view.lens_to_pupil_m);
  return surface_d.low - content.max_vergence_d <= slice.to_d &&
         surface_d.high - content.min_vergence_d >= slice.from_d;
}

}  // namespace focalstage
