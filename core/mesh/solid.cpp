#include "core/mesh/solid.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

#include <glm/geometric.hpp>

#include "core/mesh/joined_sets.h"
#include "core/mesh/measure.h"

namespace focalstage {
bool is_solid(const Mesh& mesh) {
  if (mesh.triangles.empty() || !is_closed(mesh)) return false;
  const std::vector<std::uint32_t> welded = welded_indices(mesh);
  JoinedSets groups(welded.size());
  for (const glm::uvec3& t : mesh.triangles) {
    groups.join(welded[t.x], welded[t.y]);
    groups.join(welded[t.y], welded[t.z]);
  }
  std::map<std::uint32_t, double> volume;  // six times, signed; about the origin, which a closed part does not notice
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3& a = mesh.positions_m[t.x];
    volume[groups.root(welded[t.x])] += glm::dot(a, glm::cross(mesh.positions_m[t.y], mesh.positions_m[t.z]));
  }
  return std::all_of(volume.begin(), volume.end(), [](const auto& part) { return part.second > 0.0; });
}

}  // namespace focalstage
