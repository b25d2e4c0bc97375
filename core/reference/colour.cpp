#include "core/reference/colour.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace focalstage {
namespace {

double linear_from_srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// The texel that stands at the endless grid's place `i` of a row or column of `count`.
int wrapped(std::int64_t i, int count, Wrap wrap) {
  if (wrap == Wrap::clamp) return static_cast<int>(std::clamp<std::int64_t>(i, 0, count - 1));
  const std::int64_t period = wrap == Wrap::mirror ? 2 * std::int64_t{count} : count;
  const std::int64_t within = ((i % period) + period) % period;
  return static_cast<int>(within < count ? within : period - 1 - within);
}

/// A texel's red, green, blue and alpha, 0 to 1, as the file has them.
glm::dvec4 numbers(const Texture& texture, std::int64_t column, std::int64_t row) {
  const int x = wrapped(column, texture.width_px, texture.wrap_u);
  const int y = wrapped(row, texture.height_px, texture.wrap_v);
  const std::size_t at =
      4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.width_px) + static_cast<std::size_t>(x));
  glm::dvec4 share(0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    share[static_cast<int>(i)] =
        texture.rgba16.empty() ? texture.rgba[at + i] / 255.0 : texture.rgba16[at + i] / 65535.0;
  }
  return share;
}

/// The texel in linear light, with its alpha.
glm::dvec4 texel(const Texture& texture, std::int64_t column, std::int64_t row) {
  glm::dvec4 light = numbers(texture, column, row);
  if (texture.color_space == ColorSpace::linear) return light;
  for (int i = 0; i < 3; ++i) light[i] = linear_from_srgb(light[i]);
  return light;
}

glm::dvec4 light_and_alpha(const Texture& texture, const glm::dvec2& uv) {
  if (texture.width_px < 1 || texture.height_px < 1) return glm::dvec4(1.0);
  if (texture.magnify == Magnify::nearest) {
    return texel(texture, static_cast<std::int64_t>(std::floor(uv.x * texture.width_px)),
                 static_cast<std::int64_t>(std::floor((1.0 - uv.y) * texture.height_px)));
  }
  const double x = uv.x * texture.width_px - 0.5;
  const double y = (1.0 - uv.y) * texture.height_px - 0.5;
  const double left = std::floor(x);
  const double top = std::floor(y);
  const auto column = static_cast<std::int64_t>(left);
  const auto row = static_cast<std::int64_t>(top);
  const double right_share = x - left;
  const double lower_share = y - top;
  const glm::dvec4 upper =
      (1.0 - right_share) * texel(texture, column, row) + right_share * texel(texture, column + 1, row);
  const glm::dvec4 lower =
      (1.0 - right_share) * texel(texture, column, row + 1) + right_share * texel(texture, column + 1, row + 1);
  return (1.0 - lower_share) * upper + lower_share * lower;
}

template <class T>
T blend(const std::vector<T>& values, const glm::uvec3& corner, const glm::dvec3& shares) {
  return shares.x * values[corner.x] + shares.y * values[corner.y] + shares.z * values[corner.z];
}

glm::dvec3 own_colour(const Finish& finish, const glm::dvec2& uv) {
  switch (finish.kind) {
    case Finish::Kind::flat:
      return finish.a;
    case Finish::Kind::textured:
      return finish.texture ? finish.a * texture_colour(*finish.texture, uv) : finish.a;
    case Finish::Kind::checker:
      break;
  }
  const double cell = std::floor(uv.x * finish.squares.x) + std::floor(uv.y * finish.squares.y);
  return std::fmod(cell, 2.0) == 0.0 ? finish.a : finish.b;
}

/// Light that arrives at a point from one lamp, on a surface with unit `normal`.
glm::dvec3 arriving(const Light& light, const glm::dvec3& point_m, const glm::dvec3& normal) {
  const glm::dvec3 full = light.color * light.intensity;
  if (light.kind == LightKind::sky) return full;
  if (light.kind == LightKind::sun) return full * std::max(0.0, glm::dot(normal, -glm::normalize(light.direction)));
  const glm::dvec3 towards = light.position_m - point_m;
  const double distance_m = glm::length(towards);
  if (distance_m == 0.0) return glm::dvec3(0.0);
  return full * std::max(0.0, glm::dot(normal, towards) / distance_m) / (distance_m * distance_m);
}

/// Unit normal in world space on the viewer's side: interpolated where the mesh has normals, else the face's.
glm::dvec3 normal_at(const Drawable& drawable, const glm::uvec3& corner, const glm::dvec3& shares,
                     const glm::dvec3& towards_viewer) {
  const Mesh& mesh = *drawable.mesh;
  const glm::dmat3 normals_from_mesh = glm::transpose(glm::inverse(glm::dmat3(drawable.world_from_mesh)));
  const glm::dvec3& a = mesh.positions_m[corner.x];
  const glm::dvec3 normal = mesh.normals.empty()
                                ? glm::cross(mesh.positions_m[corner.y] - a, mesh.positions_m[corner.z] - a)
                                : blend(mesh.normals, corner, shares);
  const glm::dvec3 turned = normals_from_mesh * normal;
  const double length = glm::length(turned);
  if (length == 0.0) return turned;
  return turned / (glm::dot(turned, towards_viewer) < 0.0 ? -length : length);
}

}  // namespace

glm::dvec3 texture_colour(const Texture& texture, const glm::dvec2& uv) {
  return glm::dvec3(light_and_alpha(texture, uv));
}

double texture_alpha(const Texture& texture, const glm::dvec2& uv) { return light_and_alpha(texture, uv).a; }

bool cut_away(const Drawable& drawable, std::size_t triangle, const glm::dvec3& shares) {
  const Finish& finish = drawable.finish;
  if (finish.kind != Finish::Kind::textured || !finish.texture || drawable.mesh->uvs.empty()) return false;
  const glm::dvec2 uv = blend(drawable.mesh->uvs, drawable.mesh->triangles[triangle], shares);
  return texture_alpha(*finish.texture, uv) < finish.alpha_cutoff;
}

glm::dvec3 colour_at(const Drawable& drawable, std::size_t triangle, const glm::dvec3& shares,
                     const glm::dvec3& viewer_m, const std::vector<Light>& lights) {
  const Mesh& mesh = *drawable.mesh;
  const glm::uvec3& corner = mesh.triangles[triangle];
  const glm::dvec2 uv = mesh.uvs.empty() ? glm::dvec2(0.0) : blend(mesh.uvs, corner, shares);
  glm::dvec3 own = own_colour(drawable.finish, uv);
  if (drawable.finish.vertex_colors && !mesh.colors.empty()) own *= blend(mesh.colors, corner, shares);
  if (!drawable.finish.lit) return own;

  const glm::dvec3 point_m(drawable.world_from_mesh * glm::dvec4(blend(mesh.positions_m, corner, shares), 1.0));
  const glm::dvec3 normal = normal_at(drawable, corner, shares, viewer_m - point_m);
  glm::dvec3 light(0.0);
  for (const Light& lamp : lights) light += arriving(lamp, point_m, normal);
  return own * light;
}

double luminance(const glm::dvec3& colour) { return glm::dot(colour, glm::dvec3(0.2126, 0.7152, 0.0722)); }

}  // namespace focalstage
