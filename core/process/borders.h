#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/mesh/edges.h"
#include "core/mesh/mesh.h"

namespace focalstage {

/// One closed line along the edges that only one triangle has.
struct Border {
  std::vector<std::uint32_t> vertices;  ///< in the order in which a triangle that filled it would run along it
  double length_m = 0.0;
  bool hole = false;  ///< something is missing there; else the rim of what is open, as a sheet is
};

/// The borders of a mesh whose triangles wind evenly, and that falls into `bits` of those areas; where they do not, a
/// line that does not close is left out. A border counts as a hole unless it is long for what it bounds, by the area of
/// the triangles that hang together with it: the longest of each such group, where the square of its length is more
/// than three times that area (a disc has 4 pi, the rim of a half sphere 2 pi).
std::vector<Border> borders_of(const Mesh& mesh, const Edges& edges, const TriangleGroups& bits,
                               const std::vector<double>& areas_m2);

/// Closes the holes, or every border up to `longest_m`, each by the triangles with the least area among its own
/// vertices. Borders with more than `most_border_vertices` stay.
Mesh filled(const Mesh& mesh, std::optional<double> longest_m);

inline constexpr std::size_t most_border_vertices = 500;

}  // namespace focalstage
