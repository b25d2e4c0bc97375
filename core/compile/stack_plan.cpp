#include "core/compile/stack_plan.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/compile/stack_optics.h"
#include "core/optics/vergence.h"

namespace focalstage {
namespace {

/// A blur wider than this takes long and says little: the pupil is taken smaller where it would.
constexpr double widest_blur_px = 12.0;
constexpr double usual_pairs = 45.0;   ///< of slice and focus: five slices
constexpr double widest_shift = 64.0;  ///< of a slice beside the cells, in pixels

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

const LookTile& tile_at(const PixelLooks& looks, int x, int y) {
  return looks.tiles[static_cast<std::size_t>(y / tile_side * looks.grid.columns() + x / tile_side)];
}

std::size_t place_of(const TileGrid& grid, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width_px) + static_cast<std::size_t>(x);
}

bool any(const std::vector<std::uint8_t>& marks) {
  return std::find(marks.begin(), marks.end(), std::uint8_t{1}) != marks.end();
}

/// Slices without repeats, by rising power.
std::vector<std::size_t> slices_in_order(const std::vector<SliceSetup>& slices) {
  std::vector<std::size_t> order;
  for (std::size_t n = 0; n < slices.size(); ++n) {
    if (!slices[n].empty) order.push_back(n);
  }
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return slices[a].power_d < slices[b].power_d; });
  return order;
}

/// Only the slices around the powers that are wanted near depth edges.
void keep_wanted(std::vector<std::size_t>& order, const std::vector<SliceSetup>& slices, const Range& wanted_d) {
  while (order.size() > 2 && slices[order[1]].power_d <= wanted_d.low) order.erase(order.begin());
  while (order.size() > 2 && slices[order[order.size() - 2]].power_d >= wanted_d.high) order.pop_back();
}

/// Pixels per unit of look; more where the raster is skewed.
double density_px(const LookTile& tile) {
  const glm::dmat2& m = tile.pixel_per_look;
  return std::sqrt(0.5 * (glm::dot(m[0], m[0]) + glm::dot(m[1], m[1])));
}

/// Work of one eye's plan, step by step.
class Planner {
 public:
  Planner(const WantedDepth& wanted, const PixelLooks& looks, const std::vector<SliceSetup>& slices,
          double lens_to_pupil_m)
      : wanted_(wanted), looks_(looks), slices_(slices), lens_to_pupil_m_(lens_to_pupil_m) {
    plan_.grid = looks.grid;
  }

  StackPlan run(const StackBudget& budget) {
    plan_.slices = slices_in_order(slices_);
    if (plan_.slices.size() < 2) return {};
    const std::vector<std::uint8_t> edges = depth_edges(wanted_, looks_, usual_pupil_m);
    if (!any(edges)) return {};
    measure(edges);
    const int width = plan_.grid.width_px;
    const int height = plan_.grid.height_px;
    near_ = widened(edges, width, height, blur_px());
    const std::vector<std::uint8_t> torn = widened(looks_.torn, width, height, reach_px());
    for (std::size_t i = 0; i < near_.size(); ++i) near_[i] = near_[i] != 0 && torn[i] == 0 ? 1 : 0;
    const std::vector<std::size_t> asked = asked_tiles(edges, budget);
    if (asked.empty()) return {};
    seen_ = widened(near_, width, height, blur_px());
    add_tiles(asked);
    tbb::parallel_for(std::size_t{0}, plan_.tiles.size(), [&](std::size_t i) { set_up_tile(plan_.tiles[i], torn); });
    return std::move(plan_);
  }

 private:
  int blur_px() const { return static_cast<int>(std::ceil(blur_px_)) + 1; }
  int reach_px() const { return static_cast<int>(std::ceil(blur_px_ + shift_px_)) + 2; }

  /// Which slices matter, how wide their blur gets and how far they lie beside the cells.
  void measure(const std::vector<std::uint8_t>& edges) {
    const auto around = widened(edges, plan_.grid.width_px, plan_.grid.height_px, static_cast<int>(2 * widest_blur_px));
    Range wanted_d;
    std::vector<double> densities;
    for (int y = 0; y < plan_.grid.height_px; ++y) {
      for (int x = 0; x < plan_.grid.width_px; ++x) {
        const std::size_t i = place_of(plan_.grid, x, y);
        if (around[i] == 0) continue;
        if (wanted_.power_d[i] == wanted_.power_d[i]) wanted_d.add(wanted_.power_d[i]);
        if (edges[i] != 0 && tile_at(looks_, x, y).usable) densities.push_back(density_px(tile_at(looks_, x, y)));
      }
    }
    keep_wanted(plan_.slices, slices_, wanted_d);
    plan_.foci = 2 * static_cast<int>(plan_.slices.size()) - 1;
    const auto middle = densities.begin() + static_cast<std::ptrdiff_t>(densities.size() / 2);
    std::nth_element(densities.begin(), middle, densities.end());
    densest_px_ = 1.2 * *middle;
    const double span_d = slices_[plan_.slices.back()].power_d - slices_[plan_.slices.front()].power_d;
    plan_.pupil_m = std::min(usual_pupil_m, 2.0 * widest_blur_px / (span_d * densest_px_));
    blur_px_ = plan_.pupil_m / 2.0 * span_d * densest_px_;
    for (const LookTile& tile : looks_.tiles) {
      if (fits(tile)) shift_px_ = std::max(shift_px_, widest_shift_px(tile));
    }
  }

  double widest_shift_px(const LookTile& tile) const {
    const glm::dvec2 low = glm::abs(shift_px(tile, slices_[plan_.slices.front()], lens_to_pupil_m_));
    const glm::dvec2 high = glm::abs(shift_px(tile, slices_[plan_.slices.back()], lens_to_pupil_m_));
    return std::max({low.x, low.y, high.x, high.y});
  }

  /// Where the eye sees the raster so densely that blur and shift would run over too many pixels, as on a surface that
  /// it sees edge-on, linear filtering stays.
  bool fits(const LookTile& tile) const {
    return tile.usable && density_px(tile) <= densest_px_ && widest_shift_px(tile) <= widest_shift;
  }

  /// Tiles with cells near depth edges; where they cost too much, those with the most edges.
  std::vector<std::size_t> asked_tiles(const std::vector<std::uint8_t>& edges, const StackBudget& budget) {
    const TileGrid& grid = plan_.grid;
    std::vector<int> cells(grid.count(), 0);
    std::vector<int> edge_cells(grid.count(), 0);
    for (int y = 0; y < grid.height_px; ++y) {
      for (int x = 0; x < grid.width_px; ++x) {
        const auto tile = static_cast<std::size_t>(y / tile_side * grid.columns() + x / tile_side);
        cells[tile] += near_[place_of(grid, x, y)];
        edge_cells[tile] += edges[place_of(grid, x, y)];
      }
    }
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i] > 0 && fits(looks_.tiles[i])) asked.push_back(i);
    }
    std::stable_sort(asked.begin(), asked.end(),
                     [&](std::size_t a, std::size_t b) { return edge_cells[a] > edge_cells[b]; });
    const double pairs = static_cast<double>(plan_.slice_count() * plan_.focus_count()) / usual_pairs;
    double spent = 0.0;
    std::size_t kept = 0;
    while (kept < asked.size() && (spent += budget.cost(asked[kept]) * std::max(1.0, pairs)) <= budget.limit) ++kept;
    plan_.left_tiles = asked.size() - kept;
    plan_.asked_tiles = kept;
    asked.resize(kept);
    std::sort(asked.begin(), asked.end());
    return asked;
  }

  /// The asked tiles and all that light of theirs can reach or come from.
  void add_tiles(const std::vector<std::size_t>& asked) {
    const TileGrid& grid = plan_.grid;
    const int around = (reach_px() + tile_side - 1) / tile_side;
    std::vector<std::uint8_t> kept(grid.count(), 0);
    is_asked_.assign(grid.count(), 0);
    for (const std::size_t i : asked) is_asked_[i] = kept[i] = 1;
    kept = widened(kept, grid.columns(), grid.rows(), around);
    plan_.slot_of.assign(grid.count(), -1);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if (kept[i] == 0 || !fits(looks_.tiles[i])) continue;
      plan_.slot_of[i] = static_cast<std::int32_t>(plan_.tiles.size());
      StackTile tile;
      tile.column = static_cast<int>(i) % grid.columns();
      tile.row = static_cast<int>(i) / grid.columns();
      plan_.tiles.push_back(std::move(tile));
    }
  }

  bool is_near(int x, int y) const {
    const TileGrid& grid = plan_.grid;
    if (x < 0 || y < 0 || x >= grid.width_px || y >= grid.height_px) return false;
    return near_[place_of(grid, x, y)] != 0 &&
           is_asked_[static_cast<std::size_t>(y / tile_side * grid.columns() + x / tile_side)] != 0;
  }

  void set_up_tile(StackTile& tile, const std::vector<std::uint8_t>& torn) const {
    const TileGrid& grid = plan_.grid;
    const LookTile& looks = looks_.tiles[static_cast<std::size_t>(tile.row * grid.columns() + tile.column)];
    set_optics(tile, looks, plan_, slices_, lens_to_pupil_m_);
    tile.free.assign(plan_.slice_count(), 0);
    for (int i = 0; i < tile_samples; ++i) {
      const int x = tile.column * tile_side + i % tile_side;
      const int y = tile.row * tile_side + i / tile_side;
      if (x >= grid.width_px || y >= grid.height_px || !(looks.x[i] == looks.x[i])) continue;
      const std::uint64_t bit = std::uint64_t{1} << i;
      if (torn[place_of(grid, x, y)] == 0 && seen_[place_of(grid, x, y)] != 0) tile.counted |= bit;
      if (is_near(x, y)) tile.asked |= bit;
      for (std::size_t n = 0; n < plan_.slice_count(); ++n) {
        const glm::dvec2 shift = shift_px(looks, slices_[plan_.slices[n]], lens_to_pupil_m_);
        const bool free =
            is_near(x + static_cast<int>(std::lround(shift.x)), y + static_cast<int>(std::lround(shift.y)));
        if (free && torn[place_of(grid, x, y)] == 0) tile.free[n] |= bit;
      }
    }
    tile.asked &= tile.counted;
  }

  const WantedDepth& wanted_;
  const PixelLooks& looks_;
  const std::vector<SliceSetup>& slices_;
  double lens_to_pupil_m_;
  StackPlan plan_;
  std::vector<std::uint8_t> near_;
  std::vector<std::uint8_t> seen_;  ///< where what may change can be seen
  std::vector<std::uint8_t> is_asked_;
  double densest_px_ = 0.0;  ///< pixels per unit of look
  double blur_px_ = 0.0;
  double shift_px_ = 0.0;
};

}  // namespace

bool StackTile::any_free() const {
  return std::any_of(free.begin(), free.end(), [](std::uint64_t bits) { return bits != 0; });
}

StackPlan stack_plan(const WantedDepth& wanted, const PixelLooks& looks, const std::vector<SliceSetup>& slices,
                     double lens_to_pupil_m, const StackBudget& budget) {
  return Planner(wanted, looks, slices, lens_to_pupil_m).run(budget);
}

}  // namespace focalstage
