#include "core/stage/nearest_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace focalstage {

namespace {

constexpr std::uint32_t most_in_leaf = 4;

double distance_to_edge_m(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const double squared = glm::dot(b - a, b - a);
  const double share = squared > 0.0 ? std::clamp(glm::dot(p - a, b - a) / squared, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + share * (b - a));
}

double distance_to_box_m(const glm::dvec3& p, const Bounds& box) {
  return glm::distance(p, glm::clamp(p, box.min_m, box.max_m));
}

}  // namespace

double distance_to_triangle_m(const glm::dvec3& point_m, const NearestSurface::Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double squared = glm::dot(normal, normal);
  const auto is_within = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return glm::dot(glm::cross(to - from, point_m - from), normal) >= 0.0;
  };
  if (squared > 0.0 && is_within(a, b) && is_within(b, c) && is_within(c, a)) {
    return std::abs(glm::dot(point_m - a, normal)) / std::sqrt(squared);
  }
  return std::min(
      {distance_to_edge_m(point_m, a, b), distance_to_edge_m(point_m, b, c), distance_to_edge_m(point_m, c, a)});
}

NearestSurface::NearestSurface(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  boxes_.reserve(triangles_.size());
  build(0, static_cast<std::uint32_t>(triangles_.size()));
}

void NearestSurface::build(std::uint32_t first, std::uint32_t count) {
  const std::size_t at = boxes_.size();
  boxes_.push_back({{}, first, count, 0});
  Bounds middles;
  const auto middle = [](const Triangle& t) { return t[0] + t[1] + t[2]; };
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (const glm::dvec3& corner : triangles_[i]) boxes_[at].bounds.include(corner);
    middles.include(middle(triangles_[i]));
  }
  if (count <= most_in_leaf) return;
  const glm::dvec3 size = middles.size_m();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t half = count / 2;
  const auto begin = triangles_.begin() + first;
  std::nth_element(begin, begin + half, begin + count,
                   [&](const Triangle& one, const Triangle& two) { return middle(one)[axis] < middle(two)[axis]; });
  boxes_[at].count = 0;
  build(first, half);
  boxes_[at].other = static_cast<std::uint32_t>(boxes_.size());
  build(first + half, count - half);
}

double NearestSurface::distance_m(const glm::dvec3& point_m) const {
  double least_m = std::numeric_limits<double>::infinity();
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    const Box& box = boxes_[at];
    if (distance_to_box_m(point_m, box.bounds) >= least_m) continue;
    if (box.count > 0) {
      for (std::uint32_t i = box.first; i < box.first + box.count; ++i) {
        least_m = std::min(least_m, distance_to_triangle_m(point_m, triangles_[i]));
      }
      continue;
    }
    std::uint32_t near = at + 1, far = box.other;
    if (distance_to_box_m(point_m, boxes_[far].bounds) < distance_to_box_m(point_m, boxes_[near].bounds)) {
      std::swap(near, far);
    }
    open.push_back(far);
    open.push_back(near);
  }
  return least_m;
}

}  // namespace focalstage
