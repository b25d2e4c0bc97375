#include "core/stage/albedo.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/stage/texture_sample.h"

namespace focalstage {
namespace {

bool is_pictured(const Drawable& drawable) {
  return drawable.finish.kind == Finish::Kind::textured && drawable.finish.texture && !drawable.mesh->uvs.empty();
}

bool is_painted(const Drawable& drawable) { return drawable.finish.vertex_colors && !drawable.mesh->colors.empty(); }

glm::dvec3 as_share(const glm::dvec3& color) { return glm::clamp(color, 0.0, 1.0); }

}  // namespace

glm::dvec3 albedo_at(const Drawable& drawable, std::uint32_t triangle, const glm::dvec3& weights) {
  const Mesh& mesh = *drawable.mesh;
  const glm::uvec3& t = mesh.triangles[triangle];
  glm::dvec3 color = drawable.finish.a;
  if (is_pictured(drawable)) {
    const glm::dvec2 uv = mesh.uvs[t.x] * weights.x + mesh.uvs[t.y] * weights.y + mesh.uvs[t.z] * weights.z;
    color *= sample_texture(*drawable.finish.texture, uv);
  }
  if (is_painted(drawable))
    color *= mesh.colors[t.x] * weights.x + mesh.colors[t.y] * weights.y + mesh.colors[t.z] * weights.z;
  return as_share(color);
}

std::optional<glm::dvec3> even_albedo(const Drawable& drawable) {
  if (is_pictured(drawable) || is_painted(drawable)) return std::nullopt;
  return as_share(drawable.finish.a);
}

glm::dvec3 corner_weights(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& point) {
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double area_squared = glm::dot(normal, normal);
  if (!(area_squared > 0.0)) return glm::dvec3(1.0, 0.0, 0.0);
  const double at_b = glm::dot(glm::cross(c - point, a - point), normal) / area_squared;
  const double at_c = glm::dot(glm::cross(a - point, b - point), normal) / area_squared;
  return {1.0 - at_b - at_c, at_b, at_c};
}

}  // namespace focalstage
