#include "core/compile/stack_fields.h"

#include <algorithm>
#include <cstring>

namespace focalstage {
namespace {

/// A rectangle of pixels, from a tile's first.
struct Window {
  int left = 0;
  int top = 0;
  int right = 0;  ///< one past
  int bottom = 0;

  int width() const { return right - left; }
  int height() const { return bottom - top; }
  void take_in(int x, int y, int across, int down) {
    const bool first = left == right;
    left = first ? x : std::min(left, x);
    top = first ? y : std::min(top, y);
    right = first ? x + across : std::max(right, x + across);
    bottom = first ? y + down : std::max(bottom, y + down);
  }
};

int floor_div(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

/// Copies one layer of a window; what is outside the plan is 0. False where all of it is 0.
bool copy_window(const StackPlan& plan, const StackField& field, std::size_t layers, std::size_t layer,
                 const StackTile& tile, const Window& window, std::vector<float>& to) {
  to.assign(static_cast<std::size_t>(window.width()) * static_cast<std::size_t>(window.height()), 0.0f);
  bool any = false;
  const int first_column = std::max(0, tile.column + floor_div(window.left, tile_side));
  const int last_column = std::min(plan.grid.columns() - 1, tile.column + floor_div(window.right - 1, tile_side));
  const int first_row = std::max(0, tile.row + floor_div(window.top, tile_side));
  const int last_row = std::min(plan.grid.rows() - 1, tile.row + floor_div(window.bottom - 1, tile_side));
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const std::int32_t slot = plan.slot_of[static_cast<std::size_t>(row * plan.grid.columns() + column)];
      if (slot < 0) continue;
      const float* const from = &field[(static_cast<std::size_t>(slot) * layers + layer) * tile_samples];
      const int x0 = (column - tile.column) * tile_side;
      const int y0 = (row - tile.row) * tile_side;
      const int left = std::max(x0, window.left);
      const int right = std::min(x0 + tile_side, window.right);
      for (int y = std::max(y0, window.top); y < std::min(y0 + tile_side, window.bottom); ++y) {
        float* const line = &to[static_cast<std::size_t>((y - window.top) * window.width() + left - window.left)];
        const float* const values = from + (y - y0) * tile_side + left - x0;
        for (int x = 0; x < right - left; ++x) any |= values[x] != 0.0f;
        std::memcpy(line, values, sizeof(float) * static_cast<std::size_t>(right - left));
      }
    }
  }
  return any;
}

}  // namespace

void see_tile(const Kernel& kernel, const StackPlan& plan, const StackField& light, std::size_t slot, float sign,
              float* seen) {
  const StackTile& tile = plan.tiles[slot];
  const std::size_t foci = plan.focus_count();
  thread_local std::vector<float> values;
  for (std::size_t n = 0; n < plan.slice_count(); ++n) {
    Window window;
    for (std::size_t k = 0; k < foci; ++k) {
      const StackSpan& span = tile.spans[n * foci + k];
      window.take_in(span.x, span.y, tile_side + span.width - 1, tile_side + span.height - 1);
    }
    if (!copy_window(plan, light, plan.slice_count(), n, tile, window, values)) continue;
    for (std::size_t k = 0; k < foci; ++k) {
      const StackSpan& span = tile.spans[n * foci + k];
      const int first = (span.y - window.top) * window.width() + span.x - window.left;
      kernel.spread(values.data() + first, window.width(), 1, &tile.shares[span.first], span.width, span.height, sign,
                    seen + k * tile_samples);
    }
  }
}

void trace_back_tile(const Kernel& kernel, const StackPlan& plan, const StackField& cells, std::size_t slot,
                     float* light) {
  const StackTile& tile = plan.tiles[slot];
  const std::size_t foci = plan.focus_count();
  thread_local std::vector<float> values;
  for (std::size_t k = 0; k < foci; ++k) {
    Window window;
    for (std::size_t n = 0; n < plan.slice_count(); ++n) {
      const StackSpan& span = tile.spans[n * foci + k];
      window.take_in(1 - span.x - span.width, 1 - span.y - span.height, tile_side + span.width - 1,
                     tile_side + span.height - 1);
    }
    if (!copy_window(plan, cells, foci, k, tile, window, values)) continue;
    for (std::size_t n = 0; n < plan.slice_count(); ++n) {
      const StackSpan& span = tile.spans[n * foci + k];
      const int first = (-span.y - window.top) * window.width() - span.x - window.left;
      kernel.spread(values.data() + first, window.width(), -1, &tile.shares[span.first], span.width, span.height, 1.0f,
                    light + n * tile_samples);
    }
  }
}

}  // namespace focalstage
