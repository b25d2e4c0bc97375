#include "editor/tools/surface_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/mesh/measure.h"
#include "editor/tools/srgb.h"

namespace focalstage {
namespace {

constexpr double finest_share = 1.0 / 40.0;
constexpr std::size_t large_mesh = 20'000;  // triangles: fine enough as they are
constexpr std::size_t most_rays = 20'000;   // vertices beyond which shadows are left out
constexpr double own_surface_share = 2e-3;  // a ray that ends this near before a vertex met the vertex's own face
constexpr double just_outside = 0.9;        // of the picture's size from its middle: no shadows farther out

/// Sum over the images of the light of each value, halved for an image that only one eye gets; by value of `codes`.
std::vector<float> summed_light(const FrameImages& images, const std::vector<ImageSpec>& specs, int bits,
                                double gamma) {
  std::vector<float> sum(images.bytes_per_image(), 0.0f);
  const double full = std::pow(2.0, bits) - 1.0;
  for (std::size_t i = 0; i < images.count && i < specs.size(); ++i) {
    const double share = specs[i].eye == ImageEye::both ? 1.0 : 0.5;
    std::array<float, 256> light{};
    for (std::size_t code = 0; code < light.size(); ++code) {
      light[code] = static_cast<float>(share * std::pow(std::min(static_cast<double>(code) / full, 1.0), gamma));
    }
    const std::span<const std::uint8_t> codes = images.image(i);
    for (std::size_t p = 0; p < codes.size(); ++p) sum[p] += light[codes[p]];
  }
  return sum;
}

}  // namespace

LightPicture light_picture(const FrameImages& images, const std::vector<ImageSpec>& specs, int bits, double gamma,
                           double tone) {
  const std::vector<float> sum = summed_light(images, specs, bits, gamma);
  LightPicture picture{images.width_px, images.height_px, {}};
  const auto width = static_cast<std::size_t>(images.width_px);
  const auto height = static_cast<std::size_t>(images.height_px);
  const auto channels = static_cast<std::size_t>(images.channels);
  picture.rgb.assign(width * height * 3, srgb_code(tone));
  for (std::size_t y = 1; y + 1 < height; ++y) {
    const float* from = &sum[(height - 1 - y) * width * channels];
    std::uint8_t* to = &picture.rgb[y * width * 3];
    for (std::size_t x = 1; x + 1 < width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        to[3 * x + c] = srgb_code(tone + static_cast<double>(from[x * channels + std::min(c, channels - 1)]));
      }
    }
  }
  return picture;
}

namespace {

/// A triangle as a grid of `n` parts to each side.
void cut_triangle(const Mesh& mesh, const glm::uvec3& t, std::uint32_t n, Mesh& fine) {
  const auto first = static_cast<std::uint32_t>(fine.positions_m.size());
  const auto row_start = [&](std::uint32_t row) { return first + row * (n + 1) - row * (row - 1) / 2; };
  for (std::uint32_t row = 0; row <= n; ++row) {
    for (std::uint32_t column = 0; column + row <= n; ++column) {
      const double b = static_cast<double>(column) / n;
      const double c = static_cast<double>(row) / n;
      const auto mixed = [&](const auto& list) { return (1.0 - b - c) * list[t.x] + b * list[t.y] + c * list[t.z]; };
      fine.positions_m.push_back(mixed(mesh.positions_m));
      if (!mesh.normals.empty()) fine.normals.push_back(mixed(mesh.normals));
    }
  }
  for (std::uint32_t row = 0; row < n; ++row) {
    for (std::uint32_t column = 0; column + row < n; ++column) {
      const std::uint32_t here = row_start(row) + column;
      const std::uint32_t above = row_start(row + 1) + column;
      fine.triangles.push_back({here, here + 1, above});
      if (column + row + 1 < n) fine.triangles.push_back({here + 1, above + 1, above});
    }
  }
}

}  // namespace

std::shared_ptr<const Mesh> finely_cut(const std::shared_ptr<const Mesh>& mesh) {
  const double longest_m = finest_share * glm::length(mesh_bounds(*mesh).size_m());
  if (mesh->triangles.size() > large_mesh || longest_m <= 0.0) return mesh;
  auto fine = std::make_shared<Mesh>();
  bool any = false;
  for (const glm::uvec3& t : mesh->triangles) {
    const std::vector<glm::dvec3>& p = mesh->positions_m;
    const double edge_m =
        std::max({glm::length(p[t.y] - p[t.x]), glm::length(p[t.z] - p[t.y]), glm::length(p[t.x] - p[t.z])});
    const auto n = static_cast<std::uint32_t>(std::clamp(std::ceil(edge_m / longest_m), 1.0, 40.0));
    any = any || n > 1;
    cut_triangle(*mesh, t, n, *fine);
  }
  if (!any) return mesh;
  return fine;
}

PinnedPicture pinned_picture(const Stage& stage, const ProjectorModel& projector, const Mesh& mesh,
                             const glm::dmat4& world_from_mesh, Picker& picker) {
  const Rigid projector_from_world = projector.world_from_projector.inverse();
  const glm::dvec2 size_px(projector.width_px, projector.height_px);
  const double mean_shift = projector.layout == PixelLayout::diamond ? 0.25 : 0.0;  // of a row, in columns
  const bool with_shadows = mesh.positions_m.size() <= most_rays;
  PinnedPicture pinned;
  pinned.uv.reserve(mesh.positions_m.size());
  pinned.reached.reserve(mesh.positions_m.size());
  for (const glm::dvec3& mesh_m : mesh.positions_m) {
    const glm::dvec3 world_m(world_from_mesh * glm::dvec4(mesh_m, 1.0));
    const glm::dvec3 p = projector_from_world.point(world_m);
    if (-p.z <= nearest_lit_m) {
      pinned.uv.emplace_back(-1.0f, -1.0f);
      pinned.reached.push_back(0);
      continue;
    }
    // By place, not by pixel: what is pinned is the raw lattice, and a uv that jumped from row to row would tear it. On
    // a diamond lattice the picture is so a quarter of a pixel off at most, were rows seen apart.
    const glm::dvec2 place = place_of_tangent(projector, glm::dvec2(p.x, p.y) / -p.z);
    const glm::dvec2 share = glm::dvec2(place.x - mean_shift, place.y) / size_px;
    pinned.uv.emplace_back(share.x, 1.0 - share.y);
    const double distance_m = glm::length(p);
    const bool inside = glm::length(share - 0.5) < just_outside;
    bool reached = true;
    if (inside && with_shadows) {
      const glm::dvec3 from_m = projector.world_from_projector.position_m;
      const auto hit = picker.first_surface(stage, {from_m, (world_m - from_m) / distance_m});
      reached = !hit || hit->distance_m > distance_m * (1.0 - own_surface_share);
    }
    pinned.reached.push_back(reached ? 1 : 0);
  }
  return pinned;
}

}  // namespace focalstage
