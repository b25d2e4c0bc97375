#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace focalstage {

/// A face with more corners is none that anybody modelled, and would cost more than all others of a file.
inline constexpr std::size_t most_corners = 65536;
inline constexpr const char* too_many_corners = "a face has more than 65,536 corners";

/// Cuts polygons into triangles that wind as they do. Convex ones become fans from their first corner; others lose
/// their ears one by one. One that crosses itself has no right answer: it becomes a fan and is counted.
class PolygonCutter {
 public:
  /// Appends the corner numbers (0 .. corners-1) of each triangle. False where the work for polygons that are not
  /// convex has passed all bounds for this file; nothing is appended then.
  bool cut(std::span<const glm::dvec3> corners, std::vector<glm::uvec3>& triangles);

  std::size_t crossed() const { return crossed_; }

 private:
  bool cut_ears(std::span<const glm::dvec3> corners, const glm::dvec3& normal, std::vector<glm::uvec3>& triangles);

  std::size_t crossed_ = 0;
  std::uint64_t work_left_ = 400'000'000;  ///< comparisons of a corner with an ear: about a second
};

}  // namespace focalstage
