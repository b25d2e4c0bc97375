#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/joined_sets.h"
#include "core/mesh/mesh.h"

namespace focalstage {

/// One triangle's side, between two places (vertices at equal positions are one place), `low` < `high`.
struct EdgeUse {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t triangle = 0;
  std::uint8_t side = 0;  ///< from the triangle's corner `side` to the next one
  bool forward = false;   ///< the triangle runs from `low` to `high`

  bool same_edge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

/// What hangs together in a mesh, by where its vertices stand. Triangles with two corners in one place have no part
/// in it.
class Edges {
 public:
  explicit Edges(const Mesh& mesh);

  /// Calls `visit` with all uses of each edge.
  template <class Visit>
  void each(Visit&& visit) const {
    for (std::size_t begin = 0; begin < uses_.size();) {
      std::size_t end = begin + 1;
      while (end < uses_.size() && uses_[end].same_edge(uses_[begin])) ++end;
      visit(std::span(uses_).subspan(begin, end - begin));
      begin = end;
    }
  }

  /// For each vertex the first one that stands in the same place.
  const std::vector<std::uint32_t>& place_of() const { return place_of_; }

 private:
  std::vector<std::uint32_t> place_of_;
  std::vector<EdgeUse> uses_;  ///< by edge, then by triangle
};

/// Triangles in groups that hang together, numbered by their first triangle.
struct TriangleGroups {
  std::vector<std::uint32_t> of_triangle;
  std::size_t count = 0;
};

/// The sets of triangles, numbered.
TriangleGroups numbered(JoinedSets& sets, std::size_t triangles);

/// Across every edge, or (`across_forks` false) only across those with two triangles.
TriangleGroups connected_triangles(const Mesh& mesh, const Edges& edges, bool across_forks);

/// The sum of the triangles' areas, group by group.
std::vector<double> group_areas_m2(const Mesh& mesh, const TriangleGroups& groups);

}  // namespace focalstage
