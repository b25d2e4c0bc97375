#include "tests/support/shapes.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "tests/support/chance.h"

namespace focalstage::support {
namespace {

constexpr double pi = std::numbers::pi;

void add_cell(Mesh& mesh, unsigned corner, unsigned right, unsigned above, unsigned across) {
  mesh.triangles.emplace_back(corner, right, across);
  mesh.triangles.emplace_back(corner, across, above);
}

/// Flat pieces side by side: each four corners, counter-clockwise, with a share of U.
SharedMesh flats(const std::vector<std::array<glm::dvec3, 4>>& pieces) {
  auto mesh = std::make_shared<Mesh>();
  const double width = 1.0 / static_cast<double>(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto first = static_cast<unsigned>(mesh->positions_m.size());
    const double u = static_cast<double>(i) * width;
    mesh->positions_m.insert(mesh->positions_m.end(), pieces[i].begin(), pieces[i].end());
    mesh->uvs.insert(mesh->uvs.end(), {{u, 0.0}, {u + width, 0.0}, {u + width, 1.0}, {u, 1.0}});
    add_cell(*mesh, first, first + 1, first + 3, first + 2);
  }
  return mesh;
}

}  // namespace

SharedMesh sheet(int columns, int rows, const std::function<glm::dvec3(double u, double v)>& place) {
  auto mesh = std::make_shared<Mesh>();
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const glm::dvec2 uv{static_cast<double>(column) / columns, static_cast<double>(row) / rows};
      mesh->positions_m.push_back(place(uv.x, uv.y));
      mesh->uvs.push_back(uv);
    }
  }
  const auto stride = static_cast<unsigned>(columns) + 1;
  for (unsigned row = 0; row < static_cast<unsigned>(rows); ++row) {
    for (unsigned column = 0; column + 1 < stride; ++column) {
      const unsigned corner = row * stride + column;
      add_cell(*mesh, corner, corner + 1, corner + stride, corner + stride + 1);
    }
  }
  smooth_normals(*mesh);
  return mesh;
}

SharedMesh rectangle(const glm::dvec2& size_m) {
  return sheet(1, 1, [&](double u, double v) { return glm::dvec3((u - 0.5) * size_m.x, (v - 0.5) * size_m.y, 0.0); });
}

SharedMesh bumpy(const glm::dvec2& size_m, double height_m, int cells, double waves) {
  return sheet(cells, cells, [&](double u, double v) {
    const double z = height_m * std::sin(2.0 * pi * waves * u) * std::cos(2.0 * pi * waves * v);
    return glm::dvec3((u - 0.5) * size_m.x, (v - 0.5) * size_m.y, z);
  });
}

SharedMesh step(const glm::dvec2& size_m, double depth_m) {
  const double x = size_m.x / 2.0, y = size_m.y / 2.0, z = -depth_m;
  return flats({{{{-x, -y, 0}, {0, -y, 0}, {0, y, 0}, {-x, y, 0}}},
                {{{0, -y, 0}, {0, -y, z}, {0, y, z}, {0, y, 0}}},
                {{{0, -y, z}, {x, -y, z}, {x, y, z}, {0, y, z}}}});
}

SharedMesh fold(const glm::dvec2& wing_m, double angle_deg) {
  const double half = angle_deg * pi / 360.0;
  const double x = wing_m.x * std::sin(half), z = wing_m.x * std::cos(half), y = wing_m.y / 2.0;
  return flats({{{{-x, -y, z}, {0, -y, 0}, {0, y, 0}, {-x, y, z}}}, {{{0, -y, 0}, {x, -y, z}, {x, y, z}, {0, y, 0}}}});
}

SharedMesh box(const glm::dvec3& size_m) {
  auto mesh = std::make_shared<Mesh>();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const auto first = static_cast<unsigned>(mesh->positions_m.size());
      for (const glm::dvec2& corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)}) {
        glm::dvec3 at(0.0);
        at[axis] = side;
        at[(axis + 1) % 3] = (2.0 * corner.x - 1.0) * side;  // keeps the winding outwards on both sides
        at[(axis + 2) % 3] = 2.0 * corner.y - 1.0;
        mesh->positions_m.push_back(0.5 * at * size_m);
        mesh->uvs.push_back(corner);
      }
      add_cell(*mesh, first, first + 1, first + 3, first + 2);
    }
  }
  return mesh;
}

SharedMesh blob(double radius_m, int cells, double lumps, std::uint64_t seed) {
  Chance chance(seed);
  std::array<glm::dvec4, 6> waves;  // direction and phase
  for (glm::dvec4& wave : waves) wave = {chance.direction() * chance.between(1.5, 4.0), chance.between(0.0, 2.0 * pi)};

  auto mesh = std::make_shared<Mesh>();
  std::map<std::array<int, 3>, unsigned> made;
  const auto vertex = [&](const std::array<int, 3>& key) {
    const auto [place, fresh] = made.try_emplace(key, static_cast<unsigned>(mesh->positions_m.size()));
    if (!fresh) return place->second;
    const glm::dvec3 cube = glm::dvec3(key[0], key[1], key[2]) * (2.0 / cells) - 1.0;
    const glm::dvec3 out = glm::normalize(glm::tan(cube * (pi / 4.0)));  // even cells on the ball
    double height = 0.0;
    for (const glm::dvec4& wave : waves) height += std::sin(glm::dot(glm::dvec3(wave), out) + wave.w);
    mesh->positions_m.push_back(out * radius_m * (1.0 + lumps * height / waves.size()));
    mesh->uvs.push_back({0.5 + std::atan2(out.x, out.z) / (2.0 * pi), std::acos(-out.y) / pi});
    return place->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool far : {false, true}) {
      const auto key = [&](int a, int b) {
        std::array<int, 3> at{};
        at[static_cast<std::size_t>(axis)] = far ? cells : 0;
        at[static_cast<std::size_t>((axis + 1) % 3)] = far ? a : b;
        at[static_cast<std::size_t>((axis + 2) % 3)] = far ? b : a;
        return at;
      };
      for (int a = 0; a < cells; ++a) {
        for (int b = 0; b < cells; ++b) {
          const unsigned corner = vertex(key(a, b)), right = vertex(key(a + 1, b));
          const unsigned above = vertex(key(a, b + 1)), across = vertex(key(a + 1, b + 1));
          add_cell(*mesh, corner, right, above, across);
        }
      }
    }
  }
  smooth_normals(*mesh);
  return mesh;
}

void smooth_normals(Mesh& mesh) {
  mesh.normals.assign(mesh.positions_m.size(), glm::dvec3(0.0));
  for (const glm::uvec3& corner : mesh.triangles) {
    const glm::dvec3& a = mesh.positions_m[corner.x];
    const glm::dvec3 area = glm::cross(mesh.positions_m[corner.y] - a, mesh.positions_m[corner.z] - a);
    for (int i = 0; i < 3; ++i) mesh.normals[corner[i]] += area;
  }
  for (glm::dvec3& normal : mesh.normals) {
    if (glm::dot(normal, normal) > 0.0) normal = glm::normalize(normal);
  }
}

Drawable standing(SharedMesh mesh, const Rigid& world_from_mesh, double scale) {
  glm::dmat4 world = world_from_mesh.matrix();
  for (int column = 0; column < 3; ++column) world[column] *= scale;
  return {std::move(mesh), world, {}};
}

StagedSurface surface_of(const Drawable& drawable, double illumination) {
  return {"surface", 0, illumination, {}, {drawable}};
}

StagedObject object_of(const Drawable& drawable, const Depth& depth) { return {"object", 0, depth, {}, {drawable}}; }

Rigid looking(const glm::dvec3& from_m, const glm::dvec3& to_m, double roll_rad) {
  const glm::dvec3 back = glm::normalize(from_m - to_m);
  const glm::dvec3 up = std::abs(back.y) > 0.99 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(up, back));
  const glm::dquat turned = glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back));
  return {from_m, glm::normalize(turned * glm::angleAxis(roll_rad, glm::dvec3(0, 0, 1)))};
}

}  // namespace focalstage::support
