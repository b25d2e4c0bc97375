#include "core/calibrate/scan_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>

#include <glm/geometric.hpp>

namespace focalstage {

namespace {

constexpr double least_sine = 1e-4;  // between rays: nearer to parallel they tell no depth

glm::dvec3 ray_of(const ProjectorModel& lens, const glm::dvec2& pixel) {
  return lens.world_from_projector.direction(glm::dvec3(tangent_of_pixel(lens, pixel), -1.0));
}

struct GridPoint {
  glm::dvec3 world_m{0.0};
  double depth_m = 0.0;
};

using Grid = std::vector<std::optional<GridPoint>>;

/// The mean of the points in one cell that agree with their median depth.
std::optional<GridPoint> cell_point(std::vector<GridPoint>& points, std::size_t least, double footprint) {
  if (points.size() < least) return std::nullopt;
  const auto middle = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
  std::ranges::nth_element(points, middle, {}, &GridPoint::depth_m);
  const double depth = middle->depth_m;
  GridPoint mean;
  double count = 0.0;
  for (const GridPoint& point : points) {
    if (std::abs(point.depth_m - depth) > 3.0 * footprint * depth) continue;
    mean.world_m += point.world_m;
    mean.depth_m += point.depth_m;
    count += 1.0;
  }
  if (count < static_cast<double>(least)) return std::nullopt;
  return GridPoint{mean.world_m / count, mean.depth_m / count};
}

class ScanGrid {
 public:
  ScanGrid(const ProjectorModel& camera, const ProjectorModel& projector, const DecodedCapture& decoded,
           const ScanMeshSettings& settings)
      : camera_(camera),
        projector_(projector),
        decoded_(decoded),
        settings_(settings),
        columns_(decoded.width_px / settings.step_px),
        rows_(decoded.height_px / settings.step_px),
        footprint_(settings.step_px / camera.focal_px.x) {}

  Mesh mesh() {
    fill();
    std::vector<glm::uvec3> faces;
    for (int y = 0; y + 1 < rows_; ++y) {
      for (int x = 0; x + 1 < columns_; ++x) {
        const std::uint32_t a = index(x, y);
        const std::uint32_t b = index(x + 1, y);
        const std::uint32_t c = index(x, y + 1);
        const std::uint32_t d = index(x + 1, y + 1);
        // Rows run down: this way round is towards the camera.
        add({a, c, b}, faces);
        add({b, c, d}, faces);
      }
    }
    return packed(large(faces));
  }

 private:
  std::uint32_t index(int x, int y) const { return static_cast<std::uint32_t>(y * columns_ + x); }

  void fill() {
    const Rigid camera_from_world = camera_.world_from_projector.inverse();
    const int step = settings_.step_px;
    std::vector<GridPoint> points;
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        points.clear();
        for (int k = 0; k < step * step; ++k) {
          const int x = column * step + k % step;
          const int y = row * step + k / step;
          const auto i =
              static_cast<std::size_t>(y) * static_cast<std::size_t>(decoded_.width_px) + static_cast<std::size_t>(x);
          if (!std::isfinite(decoded_.u[i])) continue;
          const auto met = meeting_rays(camera_, projector_, {x + 0.5, y + 0.5}, {decoded_.u[i], decoded_.v[i]});
          if (!met || met->off_px > settings_.most_off_px) continue;
          points.push_back({met->world_m, -camera_from_world.point(met->world_m).z});
        }
        grid_.push_back(cell_point(points, static_cast<std::size_t>((step * step + 1) / 2), footprint_));
      }
    }
  }

  void add(const glm::uvec3& face, std::vector<glm::uvec3>& faces) const {
    std::array<double, 3> depth{};
    for (int i = 0; i < 3; ++i) {
      if (!grid_[face[i]]) return;
      depth[static_cast<std::size_t>(i)] = grid_[face[i]]->depth_m;
    }
    const auto [near, far] = std::ranges::minmax(depth);
    if (far - near <= settings_.steepest * footprint_ * near) faces.push_back(face);
  }

  /// Those that hang together with enough others.
  std::vector<glm::uvec3> large(const std::vector<glm::uvec3>& faces) const {
    std::vector<std::uint32_t> leader(grid_.size());
    std::iota(leader.begin(), leader.end(), 0U);
    const auto find = [&](std::uint32_t i) {
      while (leader[i] != i) i = leader[i] = leader[leader[i]];
      return i;
    };
    for (const glm::uvec3& face : faces) {
      leader[find(face.x)] = find(face.y);
      leader[find(face.y)] = find(face.z);
    }
    std::vector<int> count(grid_.size(), 0);
    for (const glm::uvec3& face : faces) ++count[find(face.x)];
    std::vector<glm::uvec3> kept;
    for (const glm::uvec3& face : faces) {
      if (count[find(face.x)] >= settings_.least_triangles) kept.push_back(face);
    }
    return kept;
  }

  /// Only the points that faces use.
  Mesh packed(const std::vector<glm::uvec3>& faces) const {
    Mesh mesh;
    std::map<std::uint32_t, std::uint32_t> place;
    for (const glm::uvec3& face : faces) {
      glm::uvec3 packed;
      for (int i = 0; i < 3; ++i) {
        const auto [at, fresh] = place.try_emplace(face[i], static_cast<std::uint32_t>(mesh.positions_m.size()));
        if (fresh) mesh.positions_m.push_back(grid_[face[i]]->world_m);
        packed[i] = at->second;
      }
      mesh.triangles.push_back(packed);
    }
    return mesh;
  }

  const ProjectorModel& camera_;
  const ProjectorModel& projector_;
  const DecodedCapture& decoded_;
  const ScanMeshSettings& settings_;
  int columns_;
  int rows_;
  double footprint_;  // of a cell, over its depth
  Grid grid_;
};

}  // namespace

std::optional<MeetingRays> meeting_rays(const ProjectorModel& camera, const ProjectorModel& projector,
                                        const glm::dvec2& camera_px, const glm::dvec2& projector_px) {
  const glm::dvec3 a = camera.world_from_projector.position_m;
  const glm::dvec3 b = projector.world_from_projector.position_m;
  const glm::dvec3 look = ray_of(camera, camera_px);
  const glm::dvec3 light = ray_of(projector, projector_px);
  const glm::dvec3 across = glm::cross(look, light);
  const double square = glm::dot(across, across);
  if (square < least_sine * least_sine * glm::dot(look, look) * glm::dot(light, light)) return std::nullopt;
  const double along_look = glm::dot(glm::cross(b - a, light), across) / square;
  const double along_light = glm::dot(glm::cross(b - a, look), across) / square;
  if (!(along_look > 0.0) || !(along_light > 0.0)) return std::nullopt;
  // The camera's ray is a line in the projector's picture.
  const Rigid own_from_world = projector.world_from_projector.inverse();
  const glm::dvec3 line = glm::cross(own_from_world.point(a), own_from_world.direction(look));
  const glm::dvec3 own_light = own_from_world.direction(light);
  const double off = std::abs(glm::dot(line, own_light)) / std::hypot(line.x, line.y);
  return MeetingRays{0.5 * (a + along_look * look + b + along_light * light),
                     off * std::sqrt(projector.focal_px.x * projector.focal_px.y)};
}

Mesh scan_mesh(const ProjectorModel& camera, const ProjectorModel& projector, const DecodedCapture& decoded,
               const ScanMeshSettings& settings) {
  return ScanGrid(camera, projector, decoded, settings).mesh();
}

}  // namespace focalstage
