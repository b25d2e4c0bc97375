#include "devices/sim/sim_shutter.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace focalstage {

void SimShutter::command(ShutterLevel level, double time_s) {
  const double from_s = time_s + late_s_;
  const double from = at(from_s);
  while (corners_.size() > 1 && corners_.back().time_s >= from_s) corners_.pop_back();
  const bool opens = level == ShutterLevel::open;
  const double target = opens ? 1.0 : 0.0;
  corners_.push_back({from_s, from});
  const double whole_s = opens ? settings_.open_s : settings_.close_s;
  const double change_s = whole_s * std::abs(target - from);
  if (change_s > 0.0) corners_.push_back({from_s + change_s, target});
}

double SimShutter::at(double time_s) const {
  const auto after = std::ranges::upper_bound(corners_, time_s, {}, &Corner::time_s);
  if (after == corners_.begin()) return corners_.front().transmission;
  const Corner& from = *std::prev(after);
  if (after == corners_.end()) return from.transmission;
  const double share = (time_s - from.time_s) / (after->time_s - from.time_s);
  return from.transmission + share * (after->transmission - from.transmission);
}

Transmission SimShutter::during(double from_s, double to_s) const {
  const double first = at(from_s);
  const double last = at(to_s);
  Transmission seen{std::min(first, last), std::max(first, last)};
  for (const Corner& corner : corners_) {
    if (corner.time_s <= from_s || corner.time_s >= to_s) continue;
    seen.least = std::min(seen.least, corner.transmission);
    seen.most = std::max(seen.most, corner.transmission);
  }
  return seen;
}

void SimShutter::forget_before(double time_s) {
  while (corners_.size() > 2 && corners_[1].time_s < time_s) corners_.pop_front();
}

}  // namespace focalstage
