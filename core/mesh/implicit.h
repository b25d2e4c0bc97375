#pragma once

#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace focalstage {

/// A field's value and its gradient at a point.
struct FieldValue {
  double value = 0.0;
  glm::dvec3 gradient{0.0};
};

/// An ellipsoid of a blended solid. `tilt_deg` turns it about X and then about Z.
struct Ellipsoid {
  glm::dvec3 centre_m;
  glm::dvec3 radius_m;
  glm::dvec2 tilt_deg{0.0};
  double blend_m = 0.0;   ///< how far before it the solid so far begins to flow into it
  bool mirrored = false;  ///< stands at x and at -x
  bool hollow = false;    ///< is taken away instead
};

/// Ellipsoids blended in their order into one smooth solid, mirror-symmetric about x = 0. Negative inside; near the
/// surface about the distance to it. Made of roots, products and sums alone: the same bits on every processor.
class BlendedSolid {
 public:
  explicit BlendedSolid(const std::vector<Ellipsoid>& ellipsoids);

  double value(const glm::dvec3& point_m) const;
  FieldValue value_and_gradient(const glm::dvec3& point_m) const;

 private:
  struct Part {
    glm::dvec3 centre_m;
    glm::dmat3 unit_from_world;  ///< rows scaled by 1/radius: the ellipsoid becomes the unit sphere
    glm::dvec3 inverse_radius;
    double blend_m;
    double sign;
  };

  void add(const Ellipsoid& ellipsoid, double side);

  std::vector<Part> parts_;
};

}  // namespace focalstage
