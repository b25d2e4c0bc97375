#include "core/mesh/primitives.h"

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "core/mesh/circle.h"

namespace focalstage {
namespace {

/// A parallelogram seen from its front: `right` and `up` span it from `corner`, u runs from `u0` to `u1` along `right`.
void add_quad(Mesh& mesh, const glm::dvec3& corner, const glm::dvec3& right, const glm::dvec3& up, double u0 = 0.0,
              double u1 = 1.0) {
  const auto first = static_cast<std::uint32_t>(mesh.positions_m.size());
  const glm::dvec3 normal = glm::normalize(glm::cross(right, up));
  for (const glm::dvec2& at : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)}) {
    mesh.positions_m.push_back(corner + at.x * right + at.y * up);
    mesh.normals.push_back(normal);
    mesh.uvs.emplace_back(at.x == 0.0 ? u0 : u1, at.y);
  }
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  mesh.triangles.emplace_back(first, first + 2, first + 3);
}

/// Sines and cosines of `count` + 1 equal steps from `from` to `to` degrees.
std::vector<SinCos> steps_deg(double from, double to, int count) {
  std::vector<SinCos> steps;
  for (int i = 0; i <= count; ++i) steps.push_back(sin_cos_deg(from + (to - from) * i / count));
  return steps;
}

}  // namespace

Mesh make_plane(const glm::dvec2& size_m) {
  Mesh mesh;
  add_quad(mesh, {-0.5 * size_m.x, -0.5 * size_m.y, 0.0}, {size_m.x, 0.0, 0.0}, {0.0, size_m.y, 0.0});
  return mesh;
}

Mesh make_box(const glm::dvec3& size_m) {
  Mesh mesh;
  const auto face = [&](const glm::dvec3& outward, const glm::dvec3& right) {
    const glm::dvec3 up = glm::cross(outward, right);
    add_quad(mesh, 0.5 * size_m * (outward - right - up), size_m * right, size_m * up);
  };
  face({0, 0, 1}, {1, 0, 0});
  face({1, 0, 0}, {0, 0, -1});
  face({0, 0, -1}, {-1, 0, 0});
  face({-1, 0, 0}, {0, 0, 1});
  face({0, 1, 0}, {1, 0, 0});
  face({0, -1, 0}, {1, 0, 0});
  return mesh;
}

Mesh make_sphere(double radius_m) {
  constexpr int around = 128;
  constexpr int up = 64;
  const std::vector<SinCos> longitude = steps_deg(-180.0, 180.0, around);
  const std::vector<SinCos> latitude = steps_deg(-90.0, 90.0, up);
  Mesh mesh;
  for (int j = 0; j <= up; ++j) {
    const bool pole = j == 0 || j == up;
    for (int i = 0; i <= around; ++i) {
      const SinCos& east = longitude[static_cast<std::size_t>(i)];
      const SinCos& north = latitude[static_cast<std::size_t>(j)];
      // The cosine is exactly 0 at the poles and the seam's two ends are the same point: the sphere is closed.
      const glm::dvec3 outward{north.cos * east.sin, north.sin, north.cos * east.cos};
      mesh.positions_m.push_back(radius_m * outward);
      mesh.normals.push_back(outward);
      // A pole's vertex belongs to the one triangle to its right, whose middle it takes.
      mesh.uvs.emplace_back((i + (pole ? 0.5 : 0.0)) / around, static_cast<double>(j) / up);
    }
  }
  for (std::uint32_t j = 0; j < up; ++j) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t here = j * (around + 1) + i;
      const std::uint32_t above = here + around + 1;
      if (j > 0) mesh.triangles.emplace_back(here, here + 1, j + 1 < up ? above + 1 : above);
      if (j + 1 < up) mesh.triangles.emplace_back(here, above + 1, above);
    }
  }
  return mesh;
}

Mesh make_corner(const glm::dvec2& size_m, double angle_deg) {
  const SinCos half = sin_cos_deg(0.5 * angle_deg);
  const glm::dvec3 left_edge{-half.sin * size_m.x, 0.0, half.cos * size_m.x};
  const glm::dvec3 right_edge{half.sin * size_m.x, 0.0, half.cos * size_m.x};
  const glm::dvec3 down{0.0, -0.5 * size_m.y, 0.0};
  Mesh mesh;
  add_quad(mesh, left_edge + down, -left_edge, {0.0, size_m.y, 0.0}, 0.0, 0.5);
  add_quad(mesh, down, right_edge, {0.0, size_m.y, 0.0}, 0.5, 1.0);
  return mesh;
}

Mesh make_step(const glm::dvec2& size_m, double depth_m) {
  const double half_m = 0.5 * size_m.x;
  const double unfolded_m = size_m.x + std::abs(depth_m);
  const double wall_u0 = half_m / unfolded_m;
  const double wall_u1 = (half_m + std::abs(depth_m)) / unfolded_m;
  const double bottom_m = -0.5 * size_m.y;
  const glm::dvec3 up{0.0, size_m.y, 0.0};
  Mesh mesh;
  add_quad(mesh, {-half_m, bottom_m, 0.0}, {half_m, 0.0, 0.0}, up, 0.0, wall_u0);
  if (depth_m != 0.0) add_quad(mesh, {0.0, bottom_m, 0.0}, {0.0, 0.0, -depth_m}, up, wall_u0, wall_u1);
  add_quad(mesh, {0.0, bottom_m, -depth_m}, {half_m, 0.0, 0.0}, up, wall_u1, 1.0);
  return mesh;
}

}  // namespace focalstage
