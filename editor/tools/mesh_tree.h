#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/mesh/mesh.h"

namespace focalstage {

/// Where a line first meets a mesh, in the line's own measure: origin + t * direction.
struct TreeHit {
  double t = 0.0;
  std::uint32_t triangle = 0;
};

/// Finds the first triangle on a line: boxes in boxes, each cut at the median triangle when a line first comes to it,
/// so that a mesh of a million triangles costs what is looked at, not what is there. One thread's.
class MeshTree {
 public:
  explicit MeshTree(std::shared_ptr<const Mesh> mesh);

  /// The nearest triangle, seen from either side, with `from_t` < t < `to_t`. `direction` of any length.
  std::optional<TreeHit> first(const glm::dvec3& origin_m, const glm::dvec3& direction, double from_t, double to_t);

  const std::shared_ptr<const Mesh>& mesh() const { return mesh_; }

 private:
  struct Node {
    glm::vec3 low;
    glm::vec3 high;
    std::uint32_t begin = 0;  ///< of its triangles in `order_`
    std::uint32_t end = 0;
    std::uint32_t children = 0;  ///< the first of two; 0: none yet
    bool leaf = false;
  };

  Node node_over(std::uint32_t begin, std::uint32_t end) const;
  void cut(std::uint32_t node);
  void meet_leaf(const Node& node, const glm::dvec3& origin_m, const glm::dvec3& direction, double from_t, double& to_t,
                 std::optional<TreeHit>& best) const;

  std::shared_ptr<const Mesh> mesh_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace focalstage
