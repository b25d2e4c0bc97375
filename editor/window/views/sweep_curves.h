#pragma once

#include <cstdint>

#include "core/schedule/schedule.h"
#include "editor/session/solve_offer.h"
#include "editor/window/base/pane.h"
#include "editor/window/base/theme.h"

namespace focalstage {

inline constexpr std::uint32_t left_colour = theme::colour(0xF2A65A);
inline constexpr std::uint32_t right_colour = theme::colour(0x7BC47F);
inline constexpr std::uint32_t power_colour = theme::colour(0x6FB1FF);

/// Where a time and a power lie in the pane.
struct SweepAxes {
  PaneRect plot;
  float lanes_px = 0.0f;  ///< below the plot: one lane per shutter
  double period_s = 1.0 / 60.0;
  double low_d = -1.0;
  double high_d = 1.0;
  const Schedule* schedule = nullptr;

  float x(double time_s) const { return plot.min.x + plot.size.x * static_cast<float>(time_s / period_s); }
  float y(double power_d) const {
    return plot.min.y + plot.size.y * static_cast<float>((high_d - power_d) / (high_d - low_d));
  }
  double time_s(float at_x) const { return period_s * (at_x - plot.min.x) / plot.size.x; }
  double power_d(float at_y) const { return high_d - (high_d - low_d) * (at_y - plot.min.y) / plot.size.y; }
};

/// The power of both lenses; faintly the sine that a waveform stands for, and of two lenses that differ the half that
/// is not seen.
void draw_powers(const SweepAxes& axes, const Sweep& sweep);

/// The sweep and the slices as the solver proposes them: a thin curve, a ring at each exposure, dashes across.
void draw_offer(const SweepAxes& axes, const SolveOffer& offer);

}  // namespace focalstage
