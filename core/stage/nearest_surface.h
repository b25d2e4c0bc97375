#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "core/mesh/measure.h"

namespace focalstage {

/// Triangles in a tree of boxes, to ask how far a point is from them.
class NearestSurface {
 public:
  using Triangle = std::array<glm::dvec3, 3>;

  /// At least one triangle; those without area are edges or points.
  explicit NearestSurface(std::vector<Triangle> triangles);

  double distance_m(const glm::dvec3& point_m) const;

 private:
  /// A leaf has triangles, any other box two boxes: the next one, and `other`.
  struct Box {
    Bounds bounds;
    std::uint32_t first = 0;
    std::uint32_t count = 0;  ///< 0: no leaf
    std::uint32_t other = 0;
  };
  void build(std::uint32_t first, std::uint32_t count);

  std::vector<Triangle> triangles_;
  std::vector<Box> boxes_;
};

/// From a point to a triangle (Ericson, Real-Time Collision Detection, 2005, 5.1.5).
double distance_to_triangle_m(const glm::dvec3& point_m, const NearestSurface::Triangle& triangle);

}  // namespace focalstage
