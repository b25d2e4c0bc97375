#include "core/rig_measure/rising.h"

#include <cmath>

namespace focalstage {

namespace {

/// Neighbours that became one.
struct Pool {
  double first_s = 0.0;
  double last_s = 0.0;
  double mean = 0.0;
  double weight = 0.0;
};

}  // namespace

RisingCurve rising_curve(std::span<const LightPoint> points) {
  std::vector<Pool> pools;
  for (const LightPoint& point : points) {
    pools.push_back({point.time_s, point.time_s, point.value, 1.0});
    while (pools.size() > 1 && pools[pools.size() - 2].mean >= pools.back().mean) {
      const Pool last = pools.back();
      pools.pop_back();
      Pool& before = pools.back();
      before.mean = (before.mean * before.weight + last.mean * last.weight) / (before.weight + last.weight);
      before.weight += last.weight;
      before.last_s = last.last_s;
    }
  }
  RisingCurve curve;
  for (const Pool& pool : pools) {
    curve.time_s.push_back(pool.first_s);
    curve.value.push_back(pool.mean);
    if (pool.last_s > pool.first_s) {
      curve.time_s.push_back(pool.last_s);
      curve.value.push_back(pool.mean);
    }
  }
  return curve;
}

double RisingCurve::passing_s(double level) const {
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (value[i] < level) continue;
    if (i == 0) return time_s.front();
    const double share = (level - value[i - 1]) / (value[i] - value[i - 1]);
    return std::lerp(time_s[i - 1], time_s[i], share);
  }
  return time_s.empty() ? 0.0 : time_s.back();
}

}  // namespace focalstage
