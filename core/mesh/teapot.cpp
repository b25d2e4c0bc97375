#include <array>
#include <vector>

#include <glm/geometric.hpp>

#include "core/mesh/primitives.h"

namespace focalstage {
namespace {

// The control points are Newell's (1975) in the published form of 32 bicubic patches (F. C. Crow, "The Origins of the
// Teapot", IEEE CG&A 7(1), 1987), with its bottom. Given here as what they are: profiles turned about the z axis by
// quarters, and tubes whose one half mirrors the other. Units are the original's, z up, the spout along +x.
using Points = std::array<glm::dvec3, 4>;
using Patch = std::array<Points, 4>;  ///< [v][u]

struct ProfilePoint {
  double radius, z;
};
using Profile = std::array<ProfilePoint, 4>;

constexpr std::array<Profile, 6> profiles{{
    {{{0.0, 3.15}, {0.8, 3.15}, {0.0, 2.85}, {0.2, 2.7}}},             // the lid's knob
    {{{0.2, 2.7}, {0.4, 2.55}, {1.3, 2.55}, {1.3, 2.4}}},              // the lid
    {{{1.4, 2.4}, {1.3375, 2.53125}, {1.4375, 2.53125}, {1.5, 2.4}}},  // the rim
    {{{1.5, 2.4}, {1.75, 1.875}, {2.0, 1.35}, {2.0, 0.9}}},            // the body's upper
    {{{2.0, 0.9}, {2.0, 0.45}, {1.5, 0.225}, {1.5, 0.15}}},            // and lower half
    {{{1.5, 0.15}, {1.5, 0.075}, {1.425, 0.0}, {0.0, 0.0}}},           // the bottom
}};
constexpr double quarter_circle = 0.56;  ///< of the radius; the published rounding of 4/3 (sqrt 2 - 1)

/// A row across a tube: its two ends on the plane of symmetry and half its width.
struct TubeRow {
  glm::dvec2 inner_xz, outer_xz;
  double half_width;
};
using Tube = std::array<std::array<TubeRow, 4>, 2>;

const Tube handle{{
    {{{{-1.6, 2.025}, {-1.5, 2.25}, 0.3},
      {{-2.3, 2.025}, {-2.5, 2.25}, 0.3},
      {{-2.7, 2.025}, {-3.0, 2.25}, 0.3},
      {{-2.7, 1.8}, {-3.0, 1.8}, 0.3}}},
    {{{{-2.7, 1.8}, {-3.0, 1.8}, 0.3},
      {{-2.7, 1.575}, {-3.0, 1.35}, 0.3},
      {{-2.5, 1.125}, {-2.65, 0.9375}, 0.3},
      {{-2.0, 0.9}, {-1.9, 0.6}, 0.3}}},
}};
const Tube spout{{
    {{{{1.7, 1.425}, {1.7, 0.6}, 0.66},
      {{2.6, 1.425}, {3.1, 0.825}, 0.66},
      {{2.3, 2.1}, {2.4, 2.025}, 0.25},
      {{2.7, 2.4}, {3.3, 2.4}, 0.25}}},
    {{{{2.7, 2.4}, {3.3, 2.4}, 0.25},
      {{2.8, 2.475}, {3.525, 2.49375}, 0.25},
      {{2.9, 2.475}, {3.45, 2.5125}, 0.15},
      {{2.8, 2.4}, {3.2, 2.4}, 0.15}}},
}};

struct Cubic {
  std::array<double, 4> weight;
  std::array<double, 4> slope;
};

/// Bernstein's polynomials of degree 3 and their derivatives.
Cubic cubic_at(double t) {
  const double s = 1.0 - t;
  return {{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t},
          {-3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t}};
}

glm::dvec3 sum(const Patch& patch, const std::array<double, 4>& u, const std::array<double, 4>& v) {
  glm::dvec3 total(0.0);
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 4; ++i) total += v[j] * u[i] * patch[j][i];
  }
  return total;
}

/// Along the front, S_v x S_u. Where a whole row is one point (S_u = 0) the mixed derivative is S_u's limiting
/// direction.
glm::dvec3 normal_at(const Patch& patch, const glm::dvec2& t) {
  const Cubic u = cubic_at(t.x);
  const Cubic v = cubic_at(t.y);
  glm::dvec3 along_u = sum(patch, u.slope, v.weight);
  if (glm::dot(along_u, along_u) < 1e-24) along_u = sum(patch, u.slope, v.slope) * (t.y < 0.5 ? 1.0 : -1.0);
  return glm::normalize(glm::cross(sum(patch, u.weight, v.slope), along_u));
}

bool is_point(const Points& row) { return row[0] == row[1] && row[0] == row[2] && row[0] == row[3]; }

/// A row that is one point stays exactly that point, whatever the weights' sum rounds to.
glm::dvec3 position_at(const Patch& patch, const glm::dvec2& t) {
  if (t.y == 0.0 && is_point(patch[0])) return patch[0][0];
  if (t.y == 1.0 && is_point(patch[3])) return patch[3][0];
  return sum(patch, cubic_at(t.x).weight, cubic_at(t.y).weight);
}

/// What a patch covers of the unit square of UV.
struct Window {
  glm::dvec2 from, to;
};

// The original's x, y, z become ours: its spout (x) looks along +Z, its height (z) stands along +Y.
glm::dvec3 turned(const glm::dvec3& p) { return {p.y, p.z, p.x}; }

void add_patch(Mesh& mesh, const Patch& patch, const Window& window) {
  constexpr std::uint32_t cells = 10;
  constexpr double height = 3.15;
  const auto first = static_cast<std::uint32_t>(mesh.positions_m.size());
  for (std::uint32_t j = 0; j <= cells; ++j) {
    for (std::uint32_t i = 0; i <= cells; ++i) {
      const glm::dvec2 t{static_cast<double>(i) / cells, static_cast<double>(j) / cells};
      mesh.positions_m.push_back(turned(position_at(patch, t)) / height);
      mesh.normals.push_back(turned(normal_at(patch, t)));
      mesh.uvs.push_back(window.from + (window.to - window.from) * t);
    }
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto& p = mesh.positions_m;
    if (p[a] != p[b] && p[b] != p[c] && p[c] != p[a]) mesh.triangles.emplace_back(a, b, c);
  };
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t here = first + j * (cells + 1) + i;
      const std::uint32_t next = here + cells + 1;
      add(here, next, next + 1);
      add(here, next + 1, here + 1);
    }
  }
}

void add_turned(Mesh& mesh, const Profile& profile, double v_from, double v_to) {
  for (int quarter = 0; quarter < 4; ++quarter) {
    Patch patch;
    for (std::size_t j = 0; j < 4; ++j) {
      const auto [r, z] = profile[j];
      const double c = r * quarter_circle;
      patch[j] = {glm::dvec3(r, 0, z), glm::dvec3(r, c, z), glm::dvec3(c, r, z), glm::dvec3(0, r, z)};
      for (glm::dvec3& p : patch[j]) {
        for (int turn = 0; turn < quarter; ++turn) p = {-p.y, p.x, p.z};
      }
    }
    add_patch(mesh, patch, {{quarter / 4.0, v_from}, {(quarter + 1) / 4.0, v_to}});
  }
}

/// The two halves of a tube, from the inner line over one side to the outer one, and back over the other.
void add_tube(Mesh& mesh, const Tube& tube) {
  for (std::size_t section = 0; section < tube.size(); ++section) {
    Patch there;
    Patch back;
    for (std::size_t j = 0; j < 4; ++j) {
      const TubeRow& row = tube[section][j];
      const auto point = [](const glm::dvec2& xz, double y) { return glm::dvec3(xz.x, y, xz.y); };
      const double w = row.half_width;
      there[j] = {point(row.inner_xz, 0), point(row.inner_xz, w), point(row.outer_xz, w), point(row.outer_xz, 0)};
      back[j] = {point(row.outer_xz, 0), point(row.outer_xz, -w), point(row.inner_xz, -w), point(row.inner_xz, 0)};
    }
    const double v_from = 1.0 - 0.5 * static_cast<double>(section);
    add_patch(mesh, there, {{0.0, v_from}, {0.5, v_from - 0.5}});
    add_patch(mesh, back, {{0.5, v_from}, {1.0, v_from - 0.5}});
  }
}

}  // namespace

Mesh make_teapot() {
  Mesh mesh;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    const auto rows = static_cast<double>(profiles.size());
    add_turned(mesh, profiles[i], 1.0 - static_cast<double>(i) / rows, 1.0 - static_cast<double>(i + 1) / rows);
  }
  add_tube(mesh, handle);
  add_tube(mesh, spout);
  return mesh;
}

}  // namespace focalstage
