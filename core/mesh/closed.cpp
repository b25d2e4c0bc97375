#include "core/mesh/closed.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <vector>

namespace focalstage {
namespace {

/// For each vertex the first vertex at the same place.
std::vector<std::uint32_t> welded(const Mesh& mesh) {
  const auto place = [&](std::uint32_t i) {
    const glm::dvec3& p = mesh.positions_m[i];
    return std::tuple(p.x, p.y, p.z);
  };
  std::vector<std::uint32_t> order(mesh.positions_m.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return place(a) < place(b); });
  std::vector<std::uint32_t> first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && place(order[i]) == place(order[i - 1]);
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

}  // namespace

bool is_closed(const Mesh& mesh) {
  const std::vector<std::uint32_t> first = welded(mesh);
  std::vector<std::uint64_t> edges;
  edges.reserve(mesh.triangles.size() * 3);
  const auto key = [](std::uint64_t from, std::uint64_t to) { return from << 32 | to; };
  for (const glm::uvec3& t : mesh.triangles) {
    const std::uint32_t v[3] = {first[t.x], first[t.y], first[t.z]};
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;  // no area, bounds nothing
    for (int i = 0; i < 3; ++i) edges.push_back(key(v[i], v[(i + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  if (edges.empty() || std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return false;
  return std::all_of(edges.begin(), edges.end(), [&](std::uint64_t edge) {
    return std::binary_search(edges.begin(), edges.end(), key(edge & 0xffffffffu, edge >> 32));
  });
}

}  // namespace focalstage
