#include "io/assets/polygons.h"

#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace focalstage {
namespace {

/// Newell's normal: twice the area as a vector, whatever corner is reflex. Relative to the first corner, so that far
/// from the origin nothing is lost.
glm::dvec3 newell_normal(std::span<const glm::dvec3> corners) {
  glm::dvec3 normal(0.0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    normal += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  }
  return normal;
}

/// Left of a -> b for positive values, seen against `normal`'s axis.
double side(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Drops the axis along which the polygon is seen largest; counter-clockwise stays so.
std::vector<glm::dvec2> flattened(std::span<const glm::dvec3> corners, const glm::dvec3& normal) {
  const glm::dvec3 size = glm::abs(normal);
  const int drop = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int u = normal[drop] >= 0 ? (drop + 1) % 3 : (drop + 2) % 3;
  const int v = normal[drop] >= 0 ? (drop + 2) % 3 : (drop + 1) % 3;
  std::vector<glm::dvec2> flat;
  flat.reserve(corners.size());
  for (const glm::dvec3& corner : corners) flat.emplace_back(corner[u], corner[v]);
  return flat;
}

/// Turns left everywhere and once around in all: a star that winds twice also turns left everywhere.
bool is_convex(const std::vector<glm::dvec2>& flat) {
  int half_turns = 0;
  double last_dx = 0.0;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const glm::dvec2& a = flat[i];
    const glm::dvec2& b = flat[(i + 1) % flat.size()];
    if (side(a, b, flat[(i + 2) % flat.size()]) < 0.0) return false;
    const double dx = b.x - a.x;
    if (dx == 0.0) continue;
    half_turns += last_dx != 0.0 && (dx < 0.0) != (last_dx < 0.0);
    last_dx = dx;
  }
  return half_turns <= 2;
}

void add_fan(std::size_t count, std::vector<glm::uvec3>& triangles) {
  for (std::uint32_t i = 1; i + 1 < count; ++i) triangles.emplace_back(0u, i, i + 1);
}

}  // namespace

bool PolygonCutter::cut(std::span<const glm::dvec3> corners, std::vector<glm::uvec3>& triangles) {
  if (corners.size() == 3) {
    triangles.emplace_back(0u, 1u, 2u);
    return true;
  }
  const glm::dvec3 normal = newell_normal(corners);
  if (!(glm::dot(normal, normal) > 0.0) || is_convex(flattened(corners, normal))) {
    add_fan(corners.size(), triangles);
    return true;
  }
  return cut_ears(corners, normal, triangles);
}

bool PolygonCutter::cut_ears(std::span<const glm::dvec3> corners, const glm::dvec3& normal,
                             std::vector<glm::uvec3>& triangles) {
  const std::vector<glm::dvec2> flat = flattened(corners, normal);
  std::vector<std::uint32_t> left(corners.size());  // the corners not yet cut off, in order
  std::iota(left.begin(), left.end(), 0u);
  std::vector<glm::uvec3> ears;
  const auto is_ear = [&](std::size_t i) {
    const std::uint32_t a = left[(i + left.size() - 1) % left.size()];
    const std::uint32_t b = left[i];
    const std::uint32_t c = left[(i + 1) % left.size()];
    if (!(side(flat[a], flat[b], flat[c]) > 0.0)) return false;
    for (const std::uint32_t other : left) {
      const glm::dvec2& p = flat[other];
      if (p == flat[a] || p == flat[b] || p == flat[c]) continue;
      if (side(flat[a], flat[b], p) >= 0.0 && side(flat[b], flat[c], p) >= 0.0 && side(flat[c], flat[a], p) >= 0.0) {
        return false;
      }
    }
    return true;
  };
  const auto give_up = [&] {
    ++crossed_;
    add_fan(corners.size(), triangles);
    return true;
  };
  for (std::size_t at = 0, misses = 0; left.size() > 3;) {
    if (work_left_ < left.size()) return false;
    work_left_ -= left.size();
    at %= left.size();
    if (is_ear(at)) {
      ears.emplace_back(left[(at + left.size() - 1) % left.size()], left[at], left[(at + 1) % left.size()]);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
      misses = 0;
    } else if (++at, ++misses == left.size()) {
      return give_up();
    }
  }
  if (side(flat[left[0]], flat[left[1]], flat[left[2]]) < 0.0) return give_up();
  ears.emplace_back(left[0], left[1], left[2]);
  triangles.insert(triangles.end(), ears.begin(), ears.end());
  return true;
}

}  // namespace focalstage
