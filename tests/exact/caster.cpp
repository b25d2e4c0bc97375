#include "tests/exact/caster.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace focalstage::exact::forward {
namespace {

constexpr std::uint32_t leaf_size = 4;

glm::dvec3 middle(const Triangle& triangle) {
  return triangle.corner_m[0] + triangle.corner_m[1] + triangle.corner_m[2];
}

/// Möller and Trumbore's test.
std::optional<Meeting> meeting(const Triangle& triangle, const glm::dvec3& from_m, const glm::dvec3& direction) {
  const glm::dvec3 ab = triangle.corner_m[1] - triangle.corner_m[0], ac = triangle.corner_m[2] - triangle.corner_m[0];
  const glm::dvec3 across = glm::cross(direction, ac);
  const double volume = glm::dot(ab, across);
  if (volume == 0.0) return std::nullopt;
  const glm::dvec3 offset = from_m - triangle.corner_m[0];
  const double b = glm::dot(offset, across) / volume;
  const glm::dvec3 turned = glm::cross(offset, ab);
  const double c = glm::dot(direction, turned) / volume;
  constexpr double seam = 1e-12;  // neighbours overlap by a hair rather than leave a gap
  if (b < -seam || c < -seam || b + c > 1.0 + seam) return std::nullopt;
  return Meeting{glm::dot(ac, turned) / volume, 0,
                 triangle.uv[0] * (1.0 - b - c) + triangle.uv[1] * b + triangle.uv[2] * c};
}

}  // namespace

Caster::Caster(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  if (!triangles_.empty()) split(0, static_cast<std::uint32_t>(triangles_.size()));
}

std::uint32_t Caster::split(std::uint32_t begin, std::uint32_t end) {
  const auto self = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const glm::dvec3& corner : triangles_[i].corner_m) {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
  }
  nodes_[self] = {low - 1e-9, high + 1e-9, begin, end, 0};
  if (end - begin <= leaf_size) return self;
  const glm::dvec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const std::uint32_t half = begin + (end - begin) / 2;
  std::nth_element(triangles_.begin() + begin, triangles_.begin() + half, triangles_.begin() + end,
                   [&](const Triangle& a, const Triangle& b) { return middle(a)[axis] < middle(b)[axis]; });
  split(begin, half);
  nodes_[self].second = split(half, end);
  return self;
}

std::optional<Meeting> Caster::first(const glm::dvec3& from_m, const glm::dvec3& direction, double beyond) const {
  if (nodes_.empty()) return std::nullopt;
  const glm::dvec3 inverse = 1.0 / direction;  // an infinity does no harm: it clamps nothing
  std::optional<Meeting> best;
  std::array<std::uint32_t, 64> waiting{};
  std::size_t count = 1;
  while (count > 0) {
    const std::uint32_t at = waiting[--count];
    const Node& node = nodes_[at];
    const glm::dvec3 a = (node.low - from_m) * inverse, b = (node.high - from_m) * inverse;
    const glm::dvec3 in = glm::min(a, b), out = glm::max(a, b);
    const double enter = std::max({in.x, in.y, in.z, beyond});
    const double leave = std::min({out.x, out.y, out.z, best ? best->along : std::numeric_limits<double>::infinity()});
    if (!(enter <= leave)) continue;
    if (node.second != 0) {
      waiting[count++] = node.second;
      waiting[count++] = at + 1;
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      std::optional<Meeting> met = meeting(triangles_[i], from_m, direction);
      if (!met || !(met->along > beyond) || (best && met->along >= best->along)) continue;
      met->triangle = i;
      best = met;
    }
  }
  return best;
}

}  // namespace focalstage::exact::forward
