#include "editor/tools/mesh_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace focalstage {
namespace {

constexpr std::uint32_t leaf_triangles = 8;

/// Where a line enters a box; infinity where it misses it between `from_t` and `to_t`.
double enter_t(const glm::vec3& low, const glm::vec3& high, const glm::dvec3& origin_m, const glm::dvec3& inverse,
               double from_t, double to_t) {
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (static_cast<double>(low[axis]) - origin_m[axis]) * inverse[axis];
    const double b = (static_cast<double>(high[axis]) - origin_m[axis]) * inverse[axis];
    if (std::isnan(a) || std::isnan(b)) continue;  // runs within the face's plane
    from_t = std::max(from_t, std::min(a, b));
    to_t = std::min(to_t, std::max(a, b));
  }
  return from_t <= to_t ? from_t : std::numeric_limits<double>::infinity();
}

/// Moeller and Trumbore's test, from either side; infinity where the line misses.
double meet_t(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& origin_m,
              const glm::dvec3& direction) {
  constexpr double miss = std::numeric_limits<double>::infinity();
  const glm::dvec3 ab = b - a;
  const glm::dvec3 ac = c - a;
  const glm::dvec3 p = glm::cross(direction, ac);
  const double determinant = glm::dot(ab, p);
  if (determinant == 0.0) return miss;
  const glm::dvec3 from_a = origin_m - a;
  const double u = glm::dot(from_a, p) / determinant;
  if (!(u >= 0.0 && u <= 1.0)) return miss;
  const glm::dvec3 q = glm::cross(from_a, ab);
  const double v = glm::dot(direction, q) / determinant;
  if (!(v >= 0.0 && u + v <= 1.0)) return miss;
  return glm::dot(ac, q) / determinant;
}

}  // namespace

MeshTree::MeshTree(std::shared_ptr<const Mesh> mesh) : mesh_(std::move(mesh)), order_(mesh_->triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (!order_.empty()) nodes_.push_back(node_over(0, static_cast<std::uint32_t>(order_.size())));
}

MeshTree::Node MeshTree::node_over(std::uint32_t begin, std::uint32_t end) const {
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high = -low;
  for (std::uint32_t i = begin; i < end; ++i) {
    const glm::uvec3& t = mesh_->triangles[order_[i]];
    for (int corner = 0; corner < 3; ++corner) {
      const glm::dvec3& p = mesh_->positions_m[t[corner]];
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  // Rounding to single precision must not cut anything off.
  const glm::vec3 margin = 1e-6f * glm::vec3(glm::max(glm::abs(low), glm::abs(high))) + 1e-9f;
  return {glm::vec3(low) - margin, glm::vec3(high) + margin, begin, end, 0, end - begin <= leaf_triangles};
}

void MeshTree::cut(std::uint32_t number) {
  const Node node = nodes_[number];
  const glm::vec3 size = node.high - node.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto centre = [&](std::uint32_t triangle) {
    const glm::uvec3& t = mesh_->triangles[triangle];
    const std::vector<glm::dvec3>& p = mesh_->positions_m;
    return p[t.x][axis] + p[t.y][axis] + p[t.z][axis];
  };
  const std::uint32_t middle = node.begin + (node.end - node.begin) / 2;
  std::nth_element(order_.begin() + node.begin, order_.begin() + middle, order_.begin() + node.end,
                   [&](std::uint32_t a, std::uint32_t b) { return centre(a) < centre(b); });
  nodes_[number].children = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(node_over(node.begin, middle));
  nodes_.push_back(node_over(middle, node.end));
}

void MeshTree::meet_leaf(const Node& node, const glm::dvec3& origin_m, const glm::dvec3& direction, double from_t,
                         double& to_t, std::optional<TreeHit>& best) const {
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    const glm::uvec3& t = mesh_->triangles[order_[i]];
    const std::vector<glm::dvec3>& p = mesh_->positions_m;
    const double met = meet_t(p[t.x], p[t.y], p[t.z], origin_m, direction);
    if (met > from_t && met < to_t) {
      to_t = met;
      best = TreeHit{met, order_[i]};
    }
  }
}

std::optional<TreeHit> MeshTree::first(const glm::dvec3& origin_m, const glm::dvec3& direction, double from_t,
                                       double to_t) {
  std::optional<TreeHit> best;
  if (nodes_.empty()) return best;
  const glm::dvec3 inverse = 1.0 / direction;
  std::array<std::pair<std::uint32_t, double>, 128> open;  // deeper than any tree of 2^32 triangles cut in halves
  std::size_t count = 0;
  const auto push = [&](std::uint32_t node) {
    const double t = enter_t(nodes_[node].low, nodes_[node].high, origin_m, inverse, from_t, to_t);
    if (t < std::numeric_limits<double>::infinity()) open[count++] = {node, t};
  };
  push(0);
  while (count > 0) {
    const auto [number, t] = open[--count];
    if (t >= to_t) continue;
    if (nodes_[number].leaf) {
      meet_leaf(nodes_[number], origin_m, direction, from_t, to_t, best);
      continue;
    }
    if (nodes_[number].children == 0) cut(number);
    const std::uint32_t child = nodes_[number].children;
    const std::size_t before = count;
    push(child);
    push(child + 1);
    if (count == before + 2 && open[before].second < open[before + 1].second) std::swap(open[before], open[before + 1]);
  }
  return best;
}

}  // namespace focalstage
