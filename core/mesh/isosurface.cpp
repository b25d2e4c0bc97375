#include "core/mesh/isosurface.h"

#include <array>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

namespace focalstage {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFu;

/// Cube corners as bits x, y, z. Each tetrahedron climbs from corner 0 to 7 along one order of the axes (Kuhn's
/// subdivision), so that a face is cut along the same diagonal by both its cubes. Even orders first, then odd ones.
constexpr std::array<std::array<unsigned, 4>, 6> tetrahedra{
    {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 4, 6, 7}}};

class Tetrahedra {
 public:
  Tetrahedra(const BlendedSolid& solid, const SampleGrid& grid)
      : grid_(grid), samples_(grid.count + 1u), values_(std::size_t{samples_.x} * samples_.y * samples_.z) {
    vertex_on_edge_.assign(values_.size() * 8, none);
    std::size_t at = 0;
    for (std::uint32_t z = 0; z < samples_.z; ++z) {
      for (std::uint32_t y = 0; y < samples_.y; ++y) {
        for (std::uint32_t x = 0; x < samples_.x; ++x) values_[at++] = solid.value(position({x, y, z}));
      }
    }
  }

  Mesh surface() {
    for (std::uint32_t z = 0; z < grid_.count.z; ++z) {
      for (std::uint32_t y = 0; y < grid_.count.y; ++y) {
        for (std::uint32_t x = 0; x < grid_.count.x; ++x) cut_cube({x, y, z});
      }
    }
    return std::move(mesh_);
  }

 private:
  glm::dvec3 position(const glm::uvec3& sample) const { return grid_.min_m + grid_.cell_m * glm::dvec3(sample); }

  static glm::uvec3 corner(const glm::uvec3& cube, unsigned bits) {
    return cube + glm::uvec3(bits & 1u, bits >> 1 & 1u, bits >> 2 & 1u);
  }

  std::size_t index(const glm::uvec3& s) const { return (std::size_t{s.z} * samples_.y + s.y) * samples_.x + s.x; }

  bool inside(const glm::uvec3& sample) const { return values_[index(sample)] < 0.0; }

  /// The vertex on the edge between two corners of a cube, made when first asked for. `a` must climb to `b`.
  std::uint32_t vertex(const glm::uvec3& cube, unsigned a, unsigned b) {
    if (a > b) std::swap(a, b);
    const glm::uvec3 from = corner(cube, a);
    const glm::uvec3 to = corner(cube, b);
    std::uint32_t& id = vertex_on_edge_[index(from) * 8 + (b ^ a)];
    if (id == none) {
      const double t = values_[index(from)] / (values_[index(from)] - values_[index(to)]);
      id = static_cast<std::uint32_t>(mesh_.positions_m.size());
      mesh_.positions_m.push_back(position(from) + t * (position(to) - position(from)));
    }
    return id;
  }

  void cut_cube(const glm::uvec3& cube) {
    unsigned inside_count = 0;
    for (unsigned bits = 0; bits < 8; ++bits) inside_count += inside(corner(cube, bits));
    if (inside_count == 0 || inside_count == 8) return;
    for (std::size_t i = 0; i < tetrahedra.size(); ++i) cut(cube, tetrahedra[i], i < 3);
  }

  /// `right_handed`: (b - a) x (c - a) points towards d.
  void cut(const glm::uvec3& cube, const std::array<unsigned, 4>& tetrahedron, bool right_handed) {
    std::array<unsigned, 4> in{};
    std::array<unsigned, 4> out{};
    std::size_t ins = 0;
    std::size_t outs = 0;
    bool even = right_handed;
    for (std::size_t i = 0; i < 4; ++i) {
      if (inside(corner(cube, tetrahedron[i]))) {
        if (outs % 2 == 1) even = !even;  // sorting this corner before the outer ones so far
        in[ins++] = tetrahedron[i];
      } else {
        out[outs++] = tetrahedron[i];
      }
    }
    const auto at = [&](unsigned a, unsigned b) { return vertex(cube, a, b); };
    if (ins == 1) {
      triangle(at(in[0], out[0]), at(in[0], out[1]), at(in[0], out[2]), even);
    } else if (ins == 3) {
      triangle(at(in[0], out[0]), at(in[1], out[0]), at(in[2], out[0]), even);
    } else if (ins == 2) {
      triangle(at(in[0], out[0]), at(in[0], out[1]), at(in[1], out[1]), even);
      triangle(at(in[0], out[0]), at(in[1], out[1]), at(in[1], out[0]), even);
    }
  }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool even) {
    mesh_.triangles.push_back(even ? glm::uvec3(a, b, c) : glm::uvec3(a, c, b));
  }

  SampleGrid grid_;
  glm::uvec3 samples_;
  std::vector<double> values_;
  std::vector<std::uint32_t> vertex_on_edge_;
  Mesh mesh_;
};

/// Newton's steps along the gradient.
glm::dvec3 onto_surface(const BlendedSolid& solid, glm::dvec3 point_m, int steps) {
  for (int i = 0; i < steps; ++i) {
    const FieldValue field = solid.value_and_gradient(point_m);
    point_m -= field.value / glm::dot(field.gradient, field.gradient) * field.gradient;
  }
  return point_m;
}

/// Moves every vertex to the middle of its neighbours and back onto the surface: the slivers that a cut near a sample
/// leaves behind open up.
void even_out(const BlendedSolid& solid, Mesh& mesh) {
  std::vector<glm::dvec3> sum(mesh.positions_m.size(), glm::dvec3(0.0));
  std::vector<double> neighbours(mesh.positions_m.size(), 0.0);
  for (const glm::uvec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      sum[t[i]] += mesh.positions_m[t[(i + 1) % 3]];
      neighbours[t[i]] += 1.0;
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    mesh.positions_m[i] = onto_surface(solid, sum[i] / neighbours[i], 1);
  }
}

}  // namespace

Mesh polygonise(const BlendedSolid& solid, const SampleGrid& grid) {
  Mesh mesh = Tetrahedra(solid, grid).surface();
  for (int round = 0; round < 3; ++round) even_out(solid, mesh);
  mesh.normals.reserve(mesh.positions_m.size());
  for (glm::dvec3& point_m : mesh.positions_m) {
    point_m = onto_surface(solid, point_m, 2);
    mesh.normals.push_back(glm::normalize(solid.value_and_gradient(point_m).gradient));
  }
  return mesh;
}

}  // namespace focalstage
