#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

// Cameras and projectors of the tests' own: they share no formula with what is tested. Matrices of nine numbers, angles
// about axes, and the lens of D. C. Brown ("Close-range camera calibration", 1971) as OpenCV's manual writes it.
namespace own {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;  // rows

inline Vector times(const Matrix& m, const Vector& v) {
  Vector out{};
  for (std::size_t r = 0; r < 3; ++r) out[r] = m[r][0] * v[0] + m[r][1] * v[1] + m[r][2] * v[2];
  return out;
}

inline Matrix times(const Matrix& a, const Matrix& b) {
  Matrix out{};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) out[r][c] = a[r][0] * b[0][c] + a[r][1] * b[1][c] + a[r][2] * b[2][c];
  }
  return out;
}

inline Matrix transposed(const Matrix& m) {
  Matrix out{};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) out[c][r] = m[r][c];
  }
  return out;
}

inline Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector plus(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vector scaled(const Vector& a, double by) { return {a[0] * by, a[1] * by, a[2] * by}; }
inline double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double length(const Vector& a) { return std::sqrt(dot(a, a)); }

/// First about Z, then X, then Y, in degrees.
inline Matrix turned(double yaw_deg, double pitch_deg, double roll_deg) {
  const double y = yaw_deg * std::numbers::pi / 180.0;
  const double p = pitch_deg * std::numbers::pi / 180.0;
  const double r = roll_deg * std::numbers::pi / 180.0;
  const Matrix about_y{{{std::cos(y), 0, std::sin(y)}, {0, 1, 0}, {-std::sin(y), 0, std::cos(y)}}};
  const Matrix about_x{{{1, 0, 0}, {0, std::cos(p), -std::sin(p)}, {0, std::sin(p), std::cos(p)}}};
  const Matrix about_z{{{std::cos(r), -std::sin(r), 0}, {std::sin(r), std::cos(r), 0}, {0, 0, 1}}};
  return times(about_y, times(about_x, about_z));
}

/// What looks, or shines, along its -Z with +Y up; pixel i covers [i, i + 1).
struct Lens {
  int width = 1024;
  int height = 768;
  double fx = 1400.0;
  double fy = 1400.0;
  double cx = 512.0;
  double cy = 384.0;
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;
  double k3 = 0.0;
  Matrix world_from_own{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vector at{};

  /// Right and down, at distance one.
  std::array<double, 2> bent(double x, double y) const {
    const double rr = x * x + y * y;
    const double radial = 1.0 + k1 * rr + k2 * rr * rr + k3 * rr * rr * rr;
    return {x * radial + 2.0 * p1 * x * y + p2 * (rr + 2.0 * x * x),
            y * radial + p1 * (rr + 2.0 * y * y) + 2.0 * p2 * x * y};
  }

  std::optional<glm::dvec2> pixel(const Vector& world) const {
    const Vector p = times(transposed(world_from_own), minus(world, at));
    if (p[2] >= 0.0) return std::nullopt;
    const auto [x, y] = bent(p[0] / -p[2], -p[1] / -p[2]);
    return glm::dvec2(cx + fx * x, cy + fy * y);
  }

  /// The direction that a place in the picture looks in, in the world; by fixed-point iteration.
  Vector look(double u, double v) const {
    const double wanted_x = (u - cx) / fx;
    const double wanted_y = (v - cy) / fy;
    double x = wanted_x;
    double y = wanted_y;
    for (int i = 0; i < 100; ++i) {
      const auto [bent_x, bent_y] = bent(x, y);
      x += wanted_x - bent_x;
      y += wanted_y - bent_y;
      if (std::abs(wanted_x - bent_x) + std::abs(wanted_y - bent_y) < 1e-13) break;
    }
    return times(world_from_own, Vector{x, -y, -1.0});
  }
};

/// The matrix of a unit quaternion, by its own formula.
inline Matrix matrix_of(const glm::dquat& q) {
  return {{{1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y - q.z * q.w), 2 * (q.x * q.z + q.y * q.w)},
           {2 * (q.x * q.y + q.z * q.w), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z - q.x * q.w)},
           {2 * (q.x * q.z - q.y * q.w), 2 * (q.y * q.z + q.x * q.w), 1 - 2 * (q.x * q.x + q.y * q.y)}}};
}

inline double angle_deg(const Matrix& a, const Matrix& b) {
  const Matrix between = times(transposed(a), b);
  // The sine too: the cosine alone says nothing of small angles.
  const Vector axis{between[2][1] - between[1][2], between[0][2] - between[2][0], between[1][0] - between[0][1]};
  const double cosine = between[0][0] + between[1][1] + between[2][2] - 1.0;
  return std::atan2(length(axis), cosine) * 180.0 / std::numbers::pi;
}

}  // namespace own
