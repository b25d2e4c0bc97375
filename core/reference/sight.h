#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/result.h"

namespace focalstage {

/// Corners in the space of who looks: the viewpoint at the origin, looking along -Z.
using SeenTriangle = std::array<glm::dvec3, 3>;

/// What a viewpoint sees along one look.
struct Sighting {
  double depth_m = 0.0;        ///< from the viewpoint, along -Z
  std::uint32_t triangle = 0;  ///< in the list the sight was made of
  glm::dvec3 shares{0.0};      ///< the parts its three corners have in the point; they sum to one
};

/// Finds the nearest triangle along a look from the origin, both sides of it. Embree only walks its tree: every test of
/// a triangle is made here in double, so that neighbours share their edges exactly and nothing is lost to its floats.
class Sight {
 public:
  /// Points nearer than `nearest_m` are not seen. Fault "reference.embree".
  static Result<Sight> of(std::vector<SeenTriangle> triangles, double nearest_m);

  /// `look` is a position in the tangent plane: x and y over the distance along -Z. Of triangles at the same depth the
  /// first in the list is seen. What `solid` denies, if given, is not there.
  std::optional<Sighting> nearest(const glm::dvec2& look, const std::function<bool(const Sighting&)>& solid = {}) const;

 private:
  struct State;
  explicit Sight(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  std::shared_ptr<const State> state_;
};

}  // namespace focalstage
