#include "core/optics/needs.h"

#include <algorithm>
#include <cmath>

namespace focalstage {
namespace {

double power_of(int cell) { return static_cast<double>(cell) / need_cells_per_d; }

}  // namespace

void PowerHistogram::add(double power_d, std::uint64_t weight) {
  if (std::isnan(power_d) || weight == 0) return;
  const double within_d = std::clamp(power_d, -farthest_need_d, farthest_need_d);
  cells_[static_cast<int>(std::lround(within_d * need_cells_per_d))] += weight;
}

void PowerHistogram::add(const PowerHistogram& other) {
  for (const auto& [cell, weight] : other.cells_) cells_[cell] += weight;
}

std::uint64_t PowerHistogram::weight() const {
  std::uint64_t sum = 0;
  for (const auto& [cell, weight] : cells_) sum += weight;
  return sum;
}

double PowerHistogram::lowest_d() const { return empty() ? 0.0 : power_of(cells_.begin()->first); }
double PowerHistogram::highest_d() const { return empty() ? 0.0 : power_of(cells_.rbegin()->first); }

std::vector<PowerHistogram::Cell> PowerHistogram::cells() const {
  std::vector<Cell> all;
  all.reserve(cells_.size());
  for (const auto& [cell, weight] : cells_) all.push_back({power_of(cell), weight});
  return all;
}

void ObjectNeeds::add(const ObjectNeeds& more) {
  looks += more.looks;
  off_surface += more.off_surface;
  unlit += more.unlit;
  for (const Side eye : both_sides) powers[eye].add(more.powers[eye]);
}

void Needs::add(const std::vector<ObjectNeeds>& frame) {
  for (const ObjectNeeds& more : frame) {
    const auto at = std::lower_bound(objects.begin(), objects.end(), more.index,
                                     [](const ObjectNeeds& object, std::size_t index) { return object.index < index; });
    if (at == objects.end() || at->index != more.index) {
      objects.insert(at, more);
      continue;
    }
    at->add(more);
  }
}

PowerHistogram Needs::all() const {
  PowerHistogram sum;
  for (const ObjectNeeds& object : objects) {
    for (const Side eye : both_sides) sum.add(object.powers[eye]);
  }
  return sum;
}

}  // namespace focalstage
