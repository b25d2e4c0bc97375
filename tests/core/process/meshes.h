#pragma once

#include <cmath>
#include <random>

#include "core/mesh/mesh.h"
#include "core/mesh/primitives.h"

namespace focalstage::test {

/// A box that shares its corners, 12 triangles, without normals and texture.
inline Mesh plain_box(double size_m = 1.0, glm::dvec3 centre_m = glm::dvec3(0.0)) {
  Mesh box;
  for (int i = 0; i < 8; ++i) {
    box.positions_m.push_back(centre_m + size_m * (glm::dvec3(i & 1, i >> 1 & 1, i >> 2 & 1) - 0.5));
  }
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return box;
}

/// Two meshes in one.
inline Mesh both(const Mesh& a, const Mesh& b) {
  Mesh sum = a;
  const auto shift = static_cast<std::uint32_t>(a.positions_m.size());
  sum.positions_m.insert(sum.positions_m.end(), b.positions_m.begin(), b.positions_m.end());
  sum.normals.insert(sum.normals.end(), b.normals.begin(), b.normals.end());
  sum.uvs.insert(sum.uvs.end(), b.uvs.begin(), b.uvs.end());
  for (const glm::uvec3& triangle : b.triangles) sum.triangles.push_back(triangle + shift);
  return sum;
}

/// A grid of n x n squares over the unit square of XY, at the height that `z` says.
template <class Height>
Mesh grid(int n, Height&& z) {
  Mesh mesh;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      const glm::dvec2 at = glm::dvec2(x, y) / static_cast<double>(n);
      mesh.positions_m.emplace_back(at, z(at));
      mesh.uvs.push_back(at);
    }
  }
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const auto a = static_cast<std::uint32_t>(y * (n + 1) + x);
      const auto b = a + static_cast<std::uint32_t>(n) + 1;
      mesh.triangles.emplace_back(a, a + 1, b);
      mesh.triangles.emplace_back(a + 1, b + 1, b);
    }
  }
  return mesh;
}

}  // namespace focalstage::test
