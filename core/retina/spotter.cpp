#include "core/retina/spotter.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/optics/vergence.h"

namespace focalstage {
namespace {

constexpr double depth_edge_d = 0.03;  ///< a slanted surface changes by far less from pixel to pixel

}  // namespace

Spotter::Spotter(const SurfaceRaster& raster, const SliceScene& scene, const SliceEye& eye)
    : raster_(raster), scene_(scene), eye_(eye) {
  const Rigid projector_from_slice = scene.light.projector_from_world() * eye.slice_from_world.inverse();
  if (scene.focus.depth_of_field_d > 0.0) px_per_d_ = 1.0 / scene.focus.depth_of_field_d;
  turn_ = glm::mat3_cast(projector_from_slice.rotation);
  shift_m_ = projector_from_slice.position_m;
  const double most_look = scene.widest_off_axis_m / eye.lens_to_pupil_m;  // infinite where lens and pupil are one
  most_look_squared_ = most_look * most_look;
  most_inverse_m_ = 1.0 / (eye.behind_lens_m + nearest_seen_m);
}

bool Spotter::through_lens(const glm::dvec2& look) const { return !(glm::dot(look, look) > most_look_squared_); }

void Spotter::row(const LookGrid& grid, int row, SliceSpot* spots, SpotReturn* returns) const {
  for (int column = 0; column < grid.width_px; ++column) {
    const std::uint32_t face = raster_.at(column, row);
    const glm::dvec2 look = grid.look(column, row);
    if (face != SurfaceRaster::nothing && through_lens(look)) {
      spots[column] = spot(look, face, returns ? returns + column : nullptr);
    }
  }
}

/// The picture's vergence at the pupil, 1 / (1 / (1/d_p - v) + d_e), and the spot as the projector sees it; both in
/// one division each, from the inverse of the distance.
SliceSpot Spotter::spot(const glm::dvec2& look, std::uint32_t face, SpotReturn* back) const {
  const glm::dvec2 narrowed = look * eye_.narrowing;
  const double inverse_m = raster_.faces[face].inverse_depth(narrowed);
  const double beyond_lens = 1.0 - eye_.behind_lens_m * inverse_m;  // d_p * inverse_m
  const double vergence = inverse_m - eye_.power_d * beyond_lens;   // (1/d_p - v) * beyond_lens
  const double grown = beyond_lens + eye_.lens_to_pupil_m * vergence;
  SliceSpot spot;
  spot.vergence_d = static_cast<float>(grown > 0.0 ? vergence / grown : -most_vergence_d);
  const glm::dvec3 seen = turn_ * glm::dvec3(narrowed, -1.0) + shift_m_ * inverse_m;
  if (back) *back = returned(narrowed, face, seen / inverse_m);
  if (const auto pixel = scene_.light.pixel(seen, inverse_m, face)) {
    spot.x_px = static_cast<float>(pixel->x);
    spot.y_px = static_cast<float>(pixel->y);
    // Half a pixel in radius at half the depth of field off.
    if (px_per_d_ > 0.0)
      spot.spread_px = static_cast<float>(px_per_d_ * std::abs(inverse_m / -seen.z - scene_.focus.focus_d));
  }
  return spot;
}

SpotReturn Spotter::returned(const glm::dvec2& narrowed, std::uint32_t face, const glm::dvec3& projector_m) const {
  const SeenFace& seen = raster_.faces[face];
  glm::dvec3 weights(0.0);
  for (int i = 0; i < 3; ++i) weights[i] = SeenFace::at(seen.edge[i], narrowed);
  return scene_.paint->at(face, weights / (weights.x + weights.y + weights.z), projector_m);
}

bool Spotter::at_edge(int row, int column, const std::vector<SliceSpot>& spots) const {
  const auto width = static_cast<std::ptrdiff_t>(raster_.grid.width_px);
  const SliceSpot* const own = &spots[static_cast<std::size_t>(row * width + column)];
  const auto parts = [&](const SliceSpot& other) {
    return other.lit() != own->lit() || other.seen() != own->seen() ||
           std::abs(other.vergence_d - own->vergence_d) > depth_edge_d;
  };
  return (column > 0 && parts(own[-1])) || (column + 1 < width && parts(own[1])) || (row > 0 && parts(own[-width])) ||
         (row + 1 < raster_.grid.height_px && parts(own[width]));
}

std::vector<EdgeFaces::Pixel> Spotter::edges(const std::vector<SliceSpot>& spots) const {
  std::vector<std::vector<EdgeFaces::Pixel>> rows(static_cast<std::size_t>(raster_.grid.height_px));
  tbb::parallel_for(0, raster_.grid.height_px, [&](int row) {
    for (int column = 0; column < raster_.grid.width_px; ++column) {
      if (at_edge(row, column, spots)) rows[static_cast<std::size_t>(row)].push_back({column, row});
    }
  });
  std::vector<EdgeFaces::Pixel> found;
  for (const auto& row : rows) found.insert(found.end(), row.begin(), row.end());
  return found;
}

EdgePixel Spotter::parts_of(const LookGrid& grid, EdgeFaces::Pixel pixel, const EdgeFaces& faces,
                            SpotReturn* returns) const {
  constexpr int across = EdgePixel::across;
  EdgePixel parts;
  parts.column = static_cast<std::uint32_t>(pixel.column);
  std::array<double, across * across> most_inverse_m{};
  std::array<std::uint32_t, across * across> nearest;
  nearest.fill(SurfaceRaster::nothing);
  const auto look = [&](std::size_t part) {
    const double x = (static_cast<double>(part % across) + 0.5) / across - 0.5;
    const double y = (static_cast<double>(part / across) + 0.5) / across - 0.5;
    return grid.look(pixel.column + x, pixel.row + y);
  };
  for (const std::uint32_t face : faces.around(pixel)) {
    if (!raster_.boxes[face].holds(pixel.column, pixel.row)) continue;
    for (std::size_t part = 0; part < nearest.size(); ++part) {
      const glm::dvec2 narrowed = look(part) * eye_.narrowing;
      const double inverse_m = raster_.faces[face].inverse_depth(narrowed);
      const bool nearer = inverse_m > most_inverse_m[part] && inverse_m <= most_inverse_m_;
      if (!nearer || !raster_.faces[face].covers(narrowed)) continue;
      most_inverse_m[part] = inverse_m;
      nearest[part] = face;
    }
  }
  for (std::size_t part = 0; part < nearest.size(); ++part) {
    if (nearest[part] != SurfaceRaster::nothing && through_lens(look(part)))
      parts.spots[part] = spot(look(part), nearest[part], returns ? returns + part : nullptr);
  }
  return parts;
}

}  // namespace focalstage
