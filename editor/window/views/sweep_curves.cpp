#include "editor/window/views/sweep_curves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/periodic.h"
#include "editor/window/base/im.h"

namespace focalstage {
namespace {

struct Pen {
  std::uint32_t colour = 0;
  float thickness = 1.0f;
};

/// `power_d` over the shares of the period between `from` and `to`.
template <class Power>
void curve(const SweepAxes& axes, double from, double to, const Pen& pen, const Power& power_d) {
  constexpr int points = 360;
  std::vector<ImVec2> line;
  for (int i = 0; i <= points; ++i) {
    const double share = std::lerp(from, to, i / static_cast<double>(points));
    line.push_back({axes.x(share * axes.period_s), axes.y(power_d(share))});
  }
  ImGui::GetWindowDrawList()->AddPolyline(line.data(), static_cast<int>(line.size()), pen.colour, 0, px(pen.thickness));
}

}  // namespace

void draw_powers(const SweepAxes& axes, const Sweep& sweep) {
  if (sweep.waveform.left || sweep.waveform.right) {
    curve(axes, 0.0, 1.0, {theme::with_alpha(power_colour, 0.3), 1.0f}, [&](double share) {
      const double middle_d = (sweep.min_power_d + sweep.max_power_d) / 2.0;
      return middle_d - (sweep.max_power_d - sweep.min_power_d) / 2.0 * std::cos(2.0 * std::numbers::pi * share);
    });
  }
  const PerEye<std::vector<double>>& samples = axes.schedule->lens_power_d;
  const bool alike = samples.left == samples.right;
  for (const Side side : both_sides) {
    if (side == Side::right && alike) continue;
    const auto power_d = [&](double share) { return periodic_at(samples[side], share); };
    const Pen whole{theme::with_alpha(power_colour, alike ? 1.0 : 0.45), alike ? 2.0f : 1.0f};
    curve(axes, 0.0, 1.0, whole, power_d);
    if (alike || samples[side].empty()) continue;
    const auto peak = std::max_element(samples[side].begin(), samples[side].end()) - samples[side].begin();
    const double middle = static_cast<double>(peak) / static_cast<double>(samples[side].size());
    const bool left = side == Side::left;
    curve(axes, left ? 0.0 : middle, left ? middle : 1.0, {power_colour, 2.0f}, power_d);
  }
}

void draw_offer(const SweepAxes& axes, const SolveOffer& offer) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const PerEye<std::vector<double>>& samples = offer.schedule.lens_power_d;
  for (const Side side : both_sides) {
    if (side == Side::right && samples.right == samples.left) continue;
    curve(axes, 0.0, 1.0, {theme::with_alpha(theme::green, 0.9), 1.5f},
          [&](double share) { return periodic_at(samples[side], share); });
  }
  for (const Slot& slot : offer.schedule.slots) {
    list.AddCircle({axes.x(slot.start_s + 0.5 * slot.exposure_s), axes.y(slot.power_d)}, px(4), theme::green, 16,
                   px(1.5f));
  }
  const float end = axes.plot.min.x + axes.plot.size.x;
  for (const double power_d : offer.report.result.rig->powers_d) {
    const float y = axes.y(power_d);
    for (float x = axes.plot.min.x; x < end; x += px(10)) {
      list.AddLine({x, y}, {std::min(x + px(4), end), y}, theme::with_alpha(theme::green, 0.7));
    }
  }
}

}  // namespace focalstage
