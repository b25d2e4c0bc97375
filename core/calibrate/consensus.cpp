#include "core/calibrate/consensus.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <utility>

#include <glm/geometric.hpp>

#include "core/calibrate/chance.h"
#include "core/calibrate/first_poses.h"

namespace focalstage {

namespace {

constexpr double chance = 1e-3;      // of calling a good point a liar
constexpr double equations = 2.0;    // that a point brings
constexpr double least_share = 0.6;  // of the points must agree
constexpr std::size_t least_agreeing = 5;
constexpr std::size_t most_subsets = 250;

using Indices = std::vector<std::size_t>;

std::vector<PickedPoint> chosen(const std::vector<PickedPoint>& points, const Indices& which) {
  std::vector<PickedPoint> some;
  for (const std::size_t i : which) some.push_back(points[i]);
  return some;
}

std::size_t how_many_must_agree(std::size_t count) {
  const auto share = static_cast<std::size_t>(std::ceil(least_share * static_cast<double>(count)));
  return std::min(count, std::max(least_agreeing, share));
}

/// All subsets of that size where they are few, else some, always the same.
std::vector<Indices> subsets(std::size_t count, std::size_t size) {
  std::vector<Indices> found;
  std::vector<bool> taken(count, false);
  std::fill(taken.begin(), taken.begin() + static_cast<std::ptrdiff_t>(size), true);
  do {
    Indices subset;
    for (std::size_t i = 0; i < count; ++i) {
      if (taken[i]) subset.push_back(i);
    }
    found.push_back(std::move(subset));
  } while (found.size() <= most_subsets && std::prev_permutation(taken.begin(), taken.end()));
  if (found.size() <= most_subsets) return found;
  found.clear();
  std::mt19937 dice(1);
  Indices all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  while (found.size() < most_subsets) {
    for (std::size_t i = 0; i < size; ++i) std::swap(all[i], all[i + dice() % (count - i)]);
    found.emplace_back(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(size));
  }
  return found;
}

/// Nearest first.
Indices by_distance(const ProjectorModel& model, const std::vector<PickedPoint>& points) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < points.size(); ++i) order.emplace_back(distance_px(model, points[i]), i);
  std::ranges::sort(order);
  Indices indices;
  for (const auto& [distance, i] : order) indices.push_back(i);
  return indices;
}

/// The distance that so many points keep.
double distance_of_most(const ProjectorModel& model, const std::vector<PickedPoint>& points, std::size_t most) {
  std::vector<double> distances;
  for (const PickedPoint& point : points) distances.push_back(distance_px(model, point));
  const auto at = distances.begin() + static_cast<std::ptrdiff_t>(most - 1);
  std::ranges::nth_element(distances, at);
  return *at;
}

std::vector<double> focal_factors(LensFreedom freedom) {
  if (freedom == LensFreedom::fixed) return {1.0};
  std::vector<double> factors;
  for (int i = -6; i <= 6; ++i) factors.push_back(std::exp2(0.25 * i));
  return factors;
}

/// Of the projectors that a few points tell of, the one on which most agree best.
std::optional<ProjectorModel> least_median(const ProjectorModel& known, const std::vector<PickedPoint>& points,
                                           LensFreedom freedom) {
  const std::size_t most = how_many_must_agree(points.size());
  const std::vector<double> factors = focal_factors(freedom);
  std::optional<ProjectorModel> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Indices& subset : subsets(points.size(), freedom == LensFreedom::fixed ? 4 : 5)) {
    const std::vector<PickedPoint> few = chosen(points, subset);
    for (const double factor : factors) {
      ProjectorModel model = known;
      model.focal_px *= factor;
      for (const Rigid& pose : first_poses(model, few)) {
        model.world_from_projector = pose;
        const double distance = distance_of_most(model, points, most);
        if (!(distance < least)) continue;
        least = distance;
        best = model;
      }
    }
  }
  return best;
}

double freedom_left(const ProjectorFit& fit) {
  return equations * static_cast<double>(fit.off_px.size()) - static_cast<double>(fit.unknowns);
}

/// Takes in what agrees with those that are in, drops what does not, until nothing changes.
std::optional<std::pair<ProjectorFit, Indices>> grow(ProjectorFit fit, Indices in,
                                                     const std::vector<PickedPoint>& points, LensFreedom freedom) {
  double doubt = 4.0;  // the best of many lie closer than they should
  for (int round = 0; round < 20; ++round) {
    const double left = freedom_left(fit);
    if (left <= 0.0) return std::nullopt;
    const double floor_px2 = picking_px * picking_px * left;
    const double rest_px2 = std::max(doubt * fit.square_sum_px2, floor_px2);
    Indices next;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double off_px = distance_px(fit.model, points[i]);
      const double p = chance_of_gain(rest_px2 + off_px * off_px, rest_px2, equations, left);
      if (p * static_cast<double>(points.size()) >= chance) next.push_back(i);
    }
    if (next.size() < least_agreeing) return std::nullopt;
    const bool settled = next == in && doubt == 1.0;
    doubt = 1.0;
    in = std::move(next);
    auto refined = fit_projector(fit.model, chosen(points, in), freedom);
    if (!refined) return std::nullopt;
    fit = std::move(*refined);
    if (settled) break;
  }
  return std::pair(std::move(fit), std::move(in));
}

/// Takes in, nearest first, who agrees once it has a say: far from all others a good point may be off by much without.
void take_in(Consensus& found, const std::vector<PickedPoint>& points, LensFreedom freedom) {
  for (const std::size_t i : by_distance(found.fit.model, points)) {
    if (std::ranges::binary_search(found.agreeing, i)) continue;
    Indices with = found.agreeing;
    with.insert(std::ranges::upper_bound(with, i), i);
    auto fit = fit_projector(found.fit.model, chosen(points, with), freedom);
    if (!fit) continue;
    const double floor_px2 = picking_px * picking_px * freedom_left(found.fit);
    const double rest_px2 = std::max(found.fit.square_sum_px2, floor_px2);
    const double p = chance_of_gain(fit->square_sum_px2, rest_px2, equations, freedom_left(found.fit));
    if (p * static_cast<double>(points.size()) < chance) continue;
    found.agreeing = std::move(with);
    found.fit = std::move(*fit);
  }
}

/// Leaves each out in turn; where one fits by no chance, takes it out for good. True once none is.
bool leave_out(Consensus& found, const std::vector<PickedPoint>& points, LensFreedom freedom) {
  found.left_out_px.assign(found.agreeing.size(), std::nullopt);
  const double rest_freedom = freedom_left(found.fit) - equations;
  if (rest_freedom <= 0.0) return true;
  double least = 1.0;
  std::size_t suspect = 0;
  std::optional<ProjectorFit> without_suspect;
  for (std::size_t k = 0; k < found.agreeing.size(); ++k) {
    Indices others = found.agreeing;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    auto rest = fit_projector(found.fit.model, chosen(points, others), freedom);
    if (!rest) continue;
    const double off_px = distance_px(rest->model, points[found.agreeing[k]]);
    found.left_out_px[k] = off_px;
    const double p = off_px > picking_px
                         ? chance_of_gain(found.fit.square_sum_px2, rest->square_sum_px2, equations, rest_freedom)
                         : 1.0;
    if (p >= least) continue;
    least = p;
    suspect = k;
    without_suspect = std::move(rest);
  }
  if (!without_suspect || least * static_cast<double>(points.size()) >= chance) return true;
  found.agreeing.erase(found.agreeing.begin() + static_cast<std::ptrdiff_t>(suspect));
  found.fit = std::move(*without_suspect);
  return false;
}

}  // namespace

double distance_px(const ProjectorModel& model, const PickedPoint& point) {
  const auto pixel = pixel_of_world(model, point.world_m);
  return pixel ? glm::distance(*pixel, point.pixel) : std::numeric_limits<double>::infinity();
}

std::optional<Consensus> find_consensus(const ProjectorModel& known, const std::vector<PickedPoint>& points,
                                        LensFreedom freedom) {
  const auto first = least_median(known, points, freedom);
  if (!first) return std::nullopt;
  const std::size_t most = how_many_must_agree(points.size());
  Indices in = by_distance(*first, points);
  in.resize(most);
  std::ranges::sort(in);
  auto fit = fit_projector(*first, chosen(points, in), freedom);
  if (!fit) return std::nullopt;
  auto grown = grow(std::move(*fit), std::move(in), points, freedom);
  if (!grown) return std::nullopt;
  Consensus found{std::move(grown->first), std::move(grown->second), {}, {}};
  take_in(found, points, freedom);
  while (!leave_out(found, points, freedom) && found.agreeing.size() >= most) {
  }
  if (found.agreeing.size() < most) return std::nullopt;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::ranges::binary_search(found.agreeing, i)) found.lying.push_back(i);
  }
  return found;
}

}  // namespace focalstage
