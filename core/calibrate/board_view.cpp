#include "core/calibrate/board_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace focalstage {

namespace {

constexpr double nearest_px = 4.0;  // radius about a corner
constexpr double farthest_px = 20.0;
constexpr double share_of_square = 0.45;
constexpr int per_side = 3;          // places between corners
constexpr double face_share = 0.15;  // of the way between corners: a place's radius
constexpr std::size_t least_pixels = 20;
constexpr std::size_t least_corners = 8;
constexpr double off = 3.0;  // times the root mean square

using Terms = Eigen::Matrix<double, 6, 1>;
using Place = Eigen::Matrix<double, 1, 2>;

struct Sample {
  Terms terms;
  Place place;
  double weight = 0.0;
  bool in = true;
};

std::vector<Sample> samples_about(const DecodedCapture& decoded, const glm::dvec2& at, double radius) {
  std::vector<Sample> samples;
  const int left = std::max(0, static_cast<int>(at.x - radius));
  const int right = std::min(decoded.width_px - 1, static_cast<int>(at.x + radius));
  const int top = std::max(0, static_cast<int>(at.y - radius));
  const int bottom = std::min(decoded.height_px - 1, static_cast<int>(at.y + radius));
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const auto i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(decoded.width_px) + static_cast<std::size_t>(x);
      if (!std::isfinite(decoded.u[i])) continue;
      const double dx = (x + 0.5 - at.x) / radius;
      const double dy = (y + 0.5 - at.y) / radius;
      if (dx * dx + dy * dy > 1.0) continue;
      Sample& sample = samples.emplace_back();
      sample.terms << 1.0, dx, dy, dx * dx, dx * dy, dy * dy;
      sample.place << decoded.u[i], decoded.v[i];
      sample.weight = decoded.confidence[i] * decoded.confidence[i];
    }
  }
  return samples;
}

/// All four quarters about the middle have their part.
bool surrounds(const std::vector<Sample>& samples) {
  std::array<std::size_t, 4> quarters{};
  for (const Sample& s : samples) {
    if (s.in) ++quarters[(s.terms(1) > 0.0 ? 1U : 0U) + (s.terms(2) > 0.0 ? 2U : 0U)];
  }
  return std::ranges::min(quarters) >= least_pixels / 5;
}

Eigen::Matrix<double, 6, 2> fitted(const std::vector<Sample>& samples) {
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 2> side = Eigen::Matrix<double, 6, 2>::Zero();
  for (const Sample& s : samples) {
    if (!s.in) continue;
    normal += s.weight * s.terms * s.terms.transpose();
    side += s.weight * s.terms * s.place;
  }
  normal.diagonal().array() += 1e-12 * normal.trace();
  return normal.ldlt().solve(side);
}

/// Places between four neighbouring corners.
std::vector<FacePlace> face_places(const std::vector<BoardCorner>& corners, const DecodedCapture& decoded) {
  std::vector<FacePlace> places;
  const auto at = [&](double x, double y) {
    return std::ranges::find_if(
        corners, [&](const BoardCorner& c) { return glm::distance(glm::dvec2(c.board_m), glm::dvec2(x, y)) < 1e-6; });
  };
  double square = std::numeric_limits<double>::infinity();
  for (const BoardCorner& c : corners) {
    if (&c != &corners[0]) square = std::min(square, glm::distance(c.board_m, corners[0].board_m));
  }
  for (const BoardCorner& a : corners) {
    const auto b = at(a.board_m.x + square, a.board_m.y);
    const auto c = at(a.board_m.x, a.board_m.y + square);
    const auto d = at(a.board_m.x + square, a.board_m.y + square);
    if (b == corners.end() || c == corners.end() || d == corners.end()) continue;
    const double radius = std::clamp(face_share * glm::distance(a.pixel, b->pixel), 3.0, 8.0);
    for (int k = 0; k < per_side * per_side; ++k) {
      const double s = (k % per_side + 0.5) / per_side;
      const double t = (k / per_side + 0.5) / per_side;
      const glm::dvec2 between = glm::mix(glm::mix(a.pixel, b->pixel, s), glm::mix(c->pixel, d->pixel, s), t);
      const glm::dvec2 pixel = glm::floor(between) + 0.5;
      const auto place = projector_place(decoded, pixel, radius);
      if (place) places.push_back({pixel, *place});
    }
  }
  return places;
}

double nearest_neighbour(const std::vector<BoardCorner>& corners, std::size_t of) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i != of) nearest = std::min(nearest, glm::distance(corners[i].pixel, corners[of].pixel));
  }
  return nearest;
}

}  // namespace

std::optional<glm::dvec2> projector_place(const DecodedCapture& decoded, const glm::dvec2& camera_px,
                                          double radius_px) {
  std::vector<Sample> samples = samples_about(decoded, camera_px, radius_px);
  Eigen::Matrix<double, 6, 2> map;
  for (int round = 0; round < 3; ++round) {
    const auto in = static_cast<std::size_t>(std::ranges::count_if(samples, &Sample::in));
    if (in < least_pixels || !surrounds(samples)) return std::nullopt;
    map = fitted(samples);
    double squares = 0.0;
    for (const Sample& s : samples) {
      if (s.in) squares += (s.terms.transpose() * map - s.place).squaredNorm();
    }
    const double most = off * off * std::max(squares / static_cast<double>(in), 1e-6);
    for (Sample& s : samples) s.in = (s.terms.transpose() * map - s.place).squaredNorm() <= most;
  }
  const glm::dvec2 place(map(0, 0), map(0, 1));
  return std::isfinite(place.x + place.y) ? std::optional(place) : std::nullopt;
}

Result<BoardView> board_view(const std::string& name, const std::vector<BoardCorner>& corners,
                             const DecodedCapture& decoded) {
  BoardView view{name, {}, {}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double radius = std::clamp(share_of_square * nearest_neighbour(corners, i), nearest_px, farthest_px);
    const auto place = projector_place(decoded, corners[i].pixel, radius);
    if (place) view.corners.push_back({corners[i].number, corners[i].board_m, corners[i].pixel, *place});
  }
  view.face = face_places(corners, decoded);
  if (view.corners.size() >= least_corners && view.face.size() >= least_corners) return view;
  return Fault{"scan.unlit", name,
               std::to_string(view.corners.size()) + " of the board's " + std::to_string(corners.size()) +
                   " corners have a place in the projector's picture; eight are the least",
               "hold the board where the projector lights it"};
}

}  // namespace focalstage
