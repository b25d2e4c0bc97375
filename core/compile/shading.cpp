#include "core/compile/shading.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/stage/texture_sample.h"

namespace focalstage {
namespace {

glm::dvec3 checker(const Finish& finish, const glm::dvec2& uv) {
  const auto cell = static_cast<std::int64_t>(std::floor(uv.x * finish.squares.x)) +
                    static_cast<std::int64_t>(std::floor(uv.y * finish.squares.y));
  return (cell & 1) == 0 ? finish.a : finish.b;
}

/// What one light adds at `point` of a surface with unit `normal`, both in the world.
double received(const Light& light, const glm::dvec3& point, const glm::dvec3& normal) {
  if (light.kind == LightKind::sky) return light.intensity;
  if (light.kind == LightKind::sun) {
    return light.intensity * std::max(0.0, -glm::dot(normal, glm::normalize(light.direction)));
  }
  const glm::dvec3 way = light.position_m - point;
  const double distance_squared = glm::dot(way, way);
  if (distance_squared == 0.0) return 0.0;
  return light.intensity * std::max(0.0, glm::dot(normal, way) / std::sqrt(distance_squared)) / distance_squared;
}

/// The shares that the triangle's corners have in what the look meets.
glm::dvec3 weights_at(const ViewTriangle& triangle, double look_x, double look_y) {
  const glm::dvec3 weights{triangle.edge(0, look_x, look_y), triangle.edge(1, look_x, look_y),
                           triangle.edge(2, look_x, look_y)};
  return weights * (1.0 / (weights.x + weights.y + weights.z));
}

}  // namespace

Shader::Shader(const Drawable& drawable, const std::vector<Light>& lights, const Rigid& world_from_eye)
    : drawable_(&drawable), lights_(&lights), world_from_eye_(world_from_eye) {
  const Finish& finish = drawable.finish;
  // Cofactors: the inverse transpose up to a positive or negative factor, also for a flattened mesh.
  const glm::dmat3 m(drawable.world_from_mesh);
  world_normal_from_mesh_ = glm::dmat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  const bool has_uv = !drawable.mesh->uvs.empty();
  needs_uv_ = has_uv && finish.kind != Finish::Kind::flat;
  has_colors_ = finish.vertex_colors && !drawable.mesh->colors.empty();
  lit_ = finish.lit;
  cuts_ = needs_uv_ && finish.kind == Finish::Kind::textured && finish.texture && finish.alpha_cutoff > 0.0;
  uniform_ = !lit_ && !needs_uv_ && !has_colors_;
  if (uniform_) uniform_color_ = base(glm::dvec2(0.0));
}

glm::dvec3 Shader::base(const glm::dvec2& uv) const {
  const Finish& finish = drawable_->finish;
  if (finish.kind == Finish::Kind::checker) return checker(finish, uv);
  if (finish.kind == Finish::Kind::textured && finish.texture) return finish.a * sample_texture(*finish.texture, uv);
  return finish.a;
}

glm::dvec3 Shader::light(const ViewTriangle& triangle, const glm::dvec3& weights, const glm::dvec3& look_world,
                         double depth_m) const {
  const Mesh& mesh = *drawable_->mesh;
  const glm::uvec3& t = mesh.triangles[triangle.triangle];
  glm::dvec3 normal;
  if (mesh.normals.empty()) {
    const glm::dvec3& origin = mesh.positions_m[t.x];
    normal = glm::cross(mesh.positions_m[t.y] - origin, mesh.positions_m[t.z] - origin);
  } else {
    normal = mesh.normals[t.x] * weights.x + mesh.normals[t.y] * weights.y + mesh.normals[t.z] * weights.z;
  }
  normal = world_normal_from_mesh_ * normal;
  const double length = std::sqrt(glm::dot(normal, normal));
  if (length == 0.0) return glm::dvec3(0.0);
  normal /= glm::dot(normal, look_world) > 0.0 ? -length : length;  // the side that the eye sees
  const glm::dvec3 point = world_from_eye_.position_m + look_world * depth_m;
  glm::dvec3 sum(0.0);
  for (const Light& each : *lights_) sum += each.color * received(each, point, normal);
  return sum;
}

std::optional<CheckerPlanes> Shader::checker_planes(const ViewTriangle& triangle) const {
  const Finish& finish = drawable_->finish;
  if (finish.kind != Finish::Kind::checker || lit_ || !needs_uv_) return std::nullopt;
  const Mesh& mesh = *drawable_->mesh;
  const glm::uvec3& t = mesh.triangles[triangle.triangle];
  constexpr double far = 1e6;  // whole squares are counted in 32 bits
  CheckerPlanes planes{};
  for (int i = 0; i < 3; ++i) {
    const glm::dvec2 square = mesh.uvs[t[i]] * glm::dvec2(finish.squares);
    if (!(std::abs(square.x) < far) || !(std::abs(square.y) < far)) return std::nullopt;
    const double edge[3] = {triangle.a[i], triangle.b[i], triangle.c[i]};
    for (int k = 0; k < 3; ++k) {
      planes.u[k] += edge[k] * square.x;
      planes.v[k] += edge[k] * square.y;
      planes.common[k] += edge[k];
    }
  }
  return planes;
}

glm::dvec2 Shader::uv_at(const ViewTriangle& triangle, const glm::dvec3& weights) const {
  const Mesh& mesh = *drawable_->mesh;
  const glm::uvec3& t = mesh.triangles[triangle.triangle];
  return mesh.uvs[t.x] * weights.x + mesh.uvs[t.y] * weights.y + mesh.uvs[t.z] * weights.z;
}

bool Shader::is_cut(const ViewTriangle& triangle, double look_x, double look_y) const {
  if (!cuts_) return false;
  const glm::dvec2 uv = uv_at(triangle, weights_at(triangle, look_x, look_y));
  return sample_alpha(*drawable_->finish.texture, uv) < drawable_->finish.alpha_cutoff;
}

glm::dvec3 Shader::color(const ViewTriangle& triangle, double look_x, double look_y) const {
  if (uniform_) return uniform_color_;
  const glm::dvec3 weights = weights_at(triangle, look_x, look_y);
  const Mesh& mesh = *drawable_->mesh;
  const glm::uvec3& t = mesh.triangles[triangle.triangle];
  glm::dvec3 own = base(needs_uv_ ? uv_at(triangle, weights) : glm::dvec2(0.0));
  if (has_colors_) own *= mesh.colors[t.x] * weights.x + mesh.colors[t.y] * weights.y + mesh.colors[t.z] * weights.z;
  if (!lit_) return own;
  const glm::dvec3 look_world = world_from_eye_.direction({look_x, look_y, -1.0});
  return own * light(triangle, weights, look_world, 1.0 / triangle.inverse_depth(look_x, look_y));
}

}  // namespace focalstage
