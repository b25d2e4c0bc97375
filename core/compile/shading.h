#pragma once

#include <optional>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/compile/kernel.h"
#include "core/compile/view_triangles.h"
#include "core/stage/stage.h"

namespace focalstage {

/// Everything that the colour of a drawable depends on, ready to be asked per sample.
class Shader {
 public:
  Shader(const Drawable& drawable, const std::vector<Light>& lights, const Rigid& world_from_eye);

  /// Linear colour where the look (x, y) meets `triangle`, a triangle of this drawable. It can exceed one.
  glm::dvec3 color(const ViewTriangle& triangle, double look_x, double look_y) const;

  /// Whether something of this drawable is cut away by its texture's alpha.
  bool cuts() const { return cuts_; }

  /// Whether the look (x, y) meets `triangle`, a triangle of this drawable, where it is cut away.
  bool is_cut(const ViewTriangle& triangle, double look_x, double look_y) const;

  /// The squares on `triangle`, where this is an unlit checker of moderate size; none elsewhere.
  std::optional<CheckerPlanes> checker_planes(const ViewTriangle& triangle) const;
  const Finish& finish() const { return drawable_->finish; }

  /// The colour of every sample, where there is only one; null elsewhere.
  const glm::dvec3* uniform() const { return uniform_ ? &uniform_color_ : nullptr; }

 private:
  glm::dvec3 base(const glm::dvec2& uv) const;
  glm::dvec2 uv_at(const ViewTriangle& triangle, const glm::dvec3& weights) const;
  glm::dvec3 light(const ViewTriangle& triangle, const glm::dvec3& weights, const glm::dvec3& look_world,
                   double depth_m) const;

  const Drawable* drawable_;
  const std::vector<Light>* lights_;
  Rigid world_from_eye_;
  glm::dmat3 world_normal_from_mesh_;
  bool needs_uv_ = false;
  bool has_colors_ = false;
  bool lit_ = false;
  bool uniform_ = false;
  bool cuts_ = false;
  glm::dvec3 uniform_color_{0.0};
};

}  // namespace focalstage
