#include "core/compile/projector_reach.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <glm/geometric.hpp>

namespace focalstage {
namespace {

/// Cosine of incidence below which light is taken back: past 78 degrees a pixel is five times as long as wide.
constexpr double grazing_cos = 0.2;
/// Of the depth: what rounding, and the float of the kernel, may part a point and the hit on it.
constexpr double same_depth = 1e-4;
/// Pixels lying deeper than so many pixel widths behind their neighbour's face are of another body.
constexpr double jump_px = 3.0;
constexpr std::uint8_t right = 1, below = 2;

/// The picture's pixel centres, and a pixel's width around them.
Box picture_box(const ProjectorRays& rays, const ProjectorModel& model) {
  Box box = bounds_of(rays);
  const float x = static_cast<float>(1.0 / model.focal_px.x), y = static_cast<float>(1.0 / model.focal_px.y);
  return {box.min_x - x, box.min_y - y, box.max_x + x, box.max_y + y};
}

/// Far off the axis a distortion can lead back into the picture, where another look's light leaves.
bool folds_back(const ProjectorModel& model, const glm::dvec2& tangent, const glm::dvec2& pixel) {
  if (model.distortion.empty()) return false;
  const glm::dvec2 back = tangent_of_pixel(model, pixel);
  return std::abs(back.x - tangent.x) > 1e-6 || std::abs(back.y - tangent.y) > 1e-6;
}

struct PixelPlace {
  std::size_t tile;
  int sample;
};

PixelPlace place_of(const TileGrid& grid, int column, int row) {
  const int tile = row / tile_side * grid.columns() + column / tile_side;
  return {static_cast<std::size_t>(tile), row % tile_side * tile_side + column % tile_side};
}

}  // namespace

std::array<glm::dvec3, 3> corners_m(const Drawable& drawable, std::uint32_t triangle) {
  const glm::uvec3& t = drawable.mesh->triangles[triangle];
  const auto corner = [&](std::uint32_t k) {
    return glm::dvec3(drawable.world_from_mesh * glm::dvec4(drawable.mesh->positions_m[k], 1.0));
  };
  return {corner(t.x), corner(t.y), corner(t.z)};
}

double smooth_step(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

ProjectorReach::ProjectorReach(const BlendProjector& projector, const std::vector<ViewDrawable>& surfaces,
                               const Kernel& kernel)
    : projector_(projector),
      projector_from_world_(projector.model.world_from_projector.inverse()),
      surfaces_(surfaces),
      grid_{projector.model.width_px, projector.model.height_px},
      sight_(projector.model, surfaces, picture_box(projector_rays(projector.model, 1), projector.model),
             grid_.columns(), grid_.rows()),
      hits_(projector_hits(projector_rays(projector.model, 1), sight_, kernel)) {
  find_rims();
  spread_rims();
}

double ProjectorReach::pixel_m(double depth_m) const {
  return depth_m / std::min(projector_.model.focal_px.x, projector_.model.focal_px.y);
}

/// Where the plane of the face that sample `i` met lies along a look.
double ProjectorReach::plane_depth_m(const TileMet& met, int i, const glm::dvec2& tangent) const {
  const Drawable& drawable = *surfaces_[static_cast<std::size_t>(met.drawable[i])].drawable;
  const auto [a, b, c] = corners_m(drawable, met.triangle[i]);
  const glm::dvec3 normal = projector_from_world_.direction(glm::cross(b - a, c - a));
  const double along = glm::dot(normal, glm::dvec3(tangent, -1.0));
  const double off = glm::dot(normal, glm::dvec3(met.x[i], met.y[i], met.z[i]));
  return along == 0.0 ? std::numeric_limits<double>::infinity() : off / along;
}

/// Whether two neighbouring pixels lie on one body; where not, which is nearer.
bool ProjectorReach::goes_on(const TileMet& a, int i, const TileMet& b, int j, bool& a_is_nearer) const {
  if (a.drawable[i] == b.drawable[j] && a.triangle[i] == b.triangle[j]) return true;
  const double a_m = -a.z[i], b_m = -b.z[j];
  a_is_nearer = a_m < b_m;
  const double most_m = jump_px * pixel_m(std::min(a_m, b_m));
  if (std::abs(a_m - b_m) <= most_m) return true;
  return std::abs(plane_depth_m(a, i, {b.x[j] / b_m, b.y[j] / b_m}) - b_m) <= most_m ||
         std::abs(plane_depth_m(b, j, {a.x[i] / a_m, a.y[i] / a_m}) - a_m) <= most_m;
}

void ProjectorReach::find_rims() {
  const int width = grid_.width_px, height = grid_.height_px;
  const auto at = [&](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  };
  go_.assign(at(0, height), 0);
  rims_.assign(at(0, height), Rim{});
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const PixelPlace own = place_of(grid_, column, row);
      const TileMet& met = hits_.tiles[own.tile];
      if (met.drawable[own.sample] < 0) continue;
      for (const std::uint8_t way : {right, below}) {
        const int next_column = column + (way == right ? 1 : 0), next_row = row + (way == below ? 1 : 0);
        if (next_column == width || next_row == height) continue;
        const PixelPlace next = place_of(grid_, next_column, next_row);
        const TileMet& other = hits_.tiles[next.tile];
        if (other.drawable[next.sample] < 0) continue;
        bool own_is_nearer = false;
        if (goes_on(met, own.sample, other, next.sample, own_is_nearer)) {
          go_[at(column, row)] |= way;
        } else if (own_is_nearer) {
          rims_[at(next_column, next_row)] = {next_column, next_row};
        } else {
          rims_[at(column, row)] = {column, row};
        }
      }
    }
  }
}

/// The nearest rim of each pixel, handed on from neighbour to neighbour of one body (Danielsson 1980, "Euclidean
/// distance mapping"): down and up again, twice, for bodies that bend around others.
void ProjectorReach::spread_rims() {
  const int width = grid_.width_px, height = grid_.height_px;
  const auto at = [&](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  };
  const auto take = [&](int column, int row, int from_column, int from_row, std::uint8_t way) {
    const std::size_t first = at(std::min(column, from_column), std::min(row, from_row));
    const Rim& offered = rims_[at(from_column, from_row)];
    if ((go_[first] & way) == 0 || offered.column < 0) return;
    Rim& own = rims_[at(column, row)];
    const auto squared = [&](const Rim& rim) {
      const double dx = rim.column - column, dy = rim.row - row;
      return dx * dx + dy * dy;
    };
    if (own.column < 0 || squared(offered) < squared(own)) own = offered;
  };
  const auto along_row = [&](int row) {
    for (int column = 1; column < width; ++column) take(column, row, column - 1, row, right);
    for (int column = width - 1; column-- > 0;) take(column, row, column + 1, row, right);
  };
  for (int round = 0; round < 2; ++round) {
    for (int row = 0; row < height; ++row) {
      for (int column = 0; row > 0 && column < width; ++column) take(column, row, column, row - 1, below);
      along_row(row);
    }
    for (int row = height - 1; row-- > 0;) {
      for (int column = 0; column < width; ++column) take(column, row, column, row + 1, below);
      along_row(row);
    }
  }
}

double ProjectorReach::edge_share(const glm::dvec2& place) const {
  double share = 1.0;
  for (const double px : {place.x, grid_.width_px - place.x, place.y, grid_.height_px - place.y})
    share *= smooth_step(px / projector_.margin_px);
  return share;
}

double ProjectorReach::shadow_share(const glm::dvec2& pixel, const glm::dvec2& tangent, double depth_m,
                                    const SurfacePoint& point) const {
  const int column = std::clamp(static_cast<int>(pixel.x), 0, grid_.width_px - 1);
  const int row = std::clamp(static_cast<int>(pixel.y), 0, grid_.height_px - 1);
  const PixelPlace own = place_of(grid_, column, row);
  const TileMet& met = hits_.tiles[own.tile];
  if (met.drawable[own.sample] < 0) return 1.0;
  const bool same_face = met.drawable[own.sample] == point.drawable && met.triangle[own.sample] == point.triangle;
  if (!same_face) {  // the middle of the pixel may lie on the other side of a rim
    const double behind_m = depth_m - plane_depth_m(met, own.sample, tangent);
    if (std::abs(behind_m) > jump_px * pixel_m(depth_m) &&
        std::abs(depth_m + met.z[own.sample]) > jump_px * pixel_m(depth_m))
      return depth_m > -met.z[own.sample] ? 0.0 : 1.0;
  }
  const Rim& rim = rims_[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.width_px) +
                         static_cast<std::size_t>(column)];
  if (rim.column < 0) return 1.0;
  return smooth_step(glm::length(pixel - glm::dvec2(rim.column + 0.5, rim.row + 0.5)) / projector_.margin_px);
}

void ProjectorReach::firmness(const SurfacePoint* points, const Kernel& kernel, double* out) const {
  TileRays looks;
  glm::dvec3 seen_m[tile_samples];
  bool any = false;
  for (int i = 0; i < tile_samples; ++i) {
    out[i] = 0.0;
    looks.x[i] = looks.y[i] = std::numeric_limits<double>::quiet_NaN();
    if (points[i].drawable < 0) continue;
    seen_m[i] = projector_from_world_.point(points[i].world_m);
    if (!(-seen_m[i].z > nearest_lit_m)) continue;
    const glm::dvec2 tangent = glm::dvec2(seen_m[i]) / -seen_m[i].z;
    const glm::dvec2 pixel = pixel_of_tangent(projector_.model, tangent);
    const bool inside = pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < grid_.width_px && pixel.y < grid_.height_px;
    if (!inside || folds_back(projector_.model, tangent, pixel)) continue;
    looks.x[i] = tangent.x;
    looks.y[i] = tangent.y;
    any = true;
  }
  if (!any) return;
  TileMet met;
  sight_.meet(looks, kernel, met);
  for (int i = 0; i < tile_samples; ++i) {
    if (!(looks.x[i] == looks.x[i])) continue;
    const double depth_m = -seen_m[i].z;
    if (met.drawable[i] >= 0 && -met.z[i] < depth_m * (1.0 - same_depth)) continue;  // in shadow
    const glm::dvec2 tangent(looks.x[i], looks.y[i]);
    const double cosine =
        std::abs(glm::dot(projector_from_world_.direction(points[i].normal), glm::normalize(seen_m[i])));
    const double firm = edge_share(place_of_tangent(projector_.model, tangent)) *
                        shadow_share(pixel_of_tangent(projector_.model, tangent), tangent, depth_m, points[i]) *
                        smooth_step(cosine / grazing_cos);
    out[i] = std::max(firm, least_firmness);
  }
}

}  // namespace focalstage
