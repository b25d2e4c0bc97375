#include <algorithm>
#include <cmath>
#include <cstdio>

#include "io/plot/plot.h"

namespace focalstage {
namespace {

/// The smallest of 1, 2, 5 times a power of ten that is no less than `least`.
double round_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double times : {1.0, 2.0, 5.0})
    if (times * power >= least * (1.0 - 1e-9)) return times * power;
  return 10.0 * power;
}

}  // namespace

std::vector<PlotTick> round_ticks(double from, double to, int wanted) {
  std::vector<PlotTick> ticks;
  if (!std::isfinite(from) || !std::isfinite(to) || !(from < to)) return ticks;
  const double step = round_step((to - from) / std::max(1, wanted));
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  const double slack = 1e-9 * (to - from);
  const double first = std::ceil((from - slack) / step);
  for (int i = 0; i <= 10 * std::max(1, wanted); ++i) {
    const double at = (first + i) * step;
    if (at > to + slack) break;
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, at == 0.0 ? 0.0 : at);
    ticks.push_back({at, text});
  }
  return ticks;
}

}  // namespace focalstage
