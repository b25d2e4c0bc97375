#include "core/percept/focus_peak.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace focalstage {
namespace {

/// The samples about the highest that are as good as level with it.
struct Top {
  std::size_t first = 0, last = 0;
  double sharpness = 0.0;
};

std::optional<Top> top_of(std::span<const double> sharpness) {
  constexpr double level = 1.0 - 5e-4;
  std::optional<Top> top;
  for (std::size_t i = 0; i < sharpness.size(); ++i)
    if (sharpness[i] > (top ? top->sharpness : 0.0)) top = Top{i, i, sharpness[i]};
  if (!top) return {};
  while (top->first > 0 && sharpness[top->first - 1] >= level * top->sharpness) --top->first;
  while (top->last + 1 < sharpness.size() && sharpness[top->last + 1] >= level * top->sharpness) ++top->last;
  return top;
}

}  // namespace

std::optional<FocusPeak> focus_peak(std::span<const double> focus_d, std::span<const double> sharpness) {
  const auto top = top_of(sharpness.first(std::min(focus_d.size(), sharpness.size())));
  if (!top) return {};
  const double middle_d = (focus_d[top->first] + focus_d[top->last]) / 2.0;
  FocusPeak peak{middle_d, top->sharpness, false};
  const bool ends = top->first == 0 || top->last + 1 >= sharpness.size();
  if (ends || !std::isfinite(sharpness[top->first - 1]) || !std::isfinite(sharpness[top->last + 1])) return peak;
  peak.inside = true;
  // y(x) = y0 + b x + a x^2 about the top, through what stands on either side of it.
  const double left = focus_d[top->first - 1] - middle_d, right = focus_d[top->last + 1] - middle_d;
  const double slope_left = (sharpness[top->first - 1] - top->sharpness) / left;
  const double slope_right = (sharpness[top->last + 1] - top->sharpness) / right;
  const double a = (slope_right - slope_left) / (right - left);
  const double b = slope_left - a * left;
  peak.focus_d += -b / (2.0 * a);  // a < 0: both neighbours lie lower
  peak.sharpness += -b * b / (4.0 * a);
  return peak;
}

}  // namespace focalstage
