#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace focalstage::exact::forward {

/// A triangle in the world; `owner` is whatever it belongs to.
struct Triangle {
  std::array<glm::dvec3, 3> corner_m;
  std::array<glm::dvec2, 3> uv;
  std::size_t owner = 0;
};

/// Where a line meets a triangle first.
struct Meeting {
  double along = 0.0;  ///< in lengths of the line's direction
  std::size_t triangle = 0;
  glm::dvec2 uv{0.0};
};

/// Finds the first triangle along a line: a plain tree of boxes in double, made for this test alone.
class Caster {
 public:
  explicit Caster(std::vector<Triangle> triangles);

  /// The first meeting further along than `beyond`, both sides of triangles.
  std::optional<Meeting> first(const glm::dvec3& from_m, const glm::dvec3& direction, double beyond) const;

  const Triangle& triangle(std::size_t i) const { return triangles_[i]; }

 private:
  struct Node {
    glm::dvec3 low{0.0}, high{0.0};
    std::uint32_t begin = 0, end = 0;  ///< a leaf's triangles
    std::uint32_t second = 0;          ///< the second child; 0 in a leaf; the first one follows its parent
  };

  std::uint32_t split(std::uint32_t begin, std::uint32_t end);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace focalstage::exact::forward
