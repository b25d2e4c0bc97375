#include "core/mesh/solid.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <vector>

#include <glm/geometric.hpp>

#include "core/mesh/measure.h"

namespace focalstage {
namespace {

/// Sets that grow together: which corners hang together through triangles.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t of(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[of(a)] = of(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

bool is_solid(const Mesh& mesh) {
  if (mesh.triangles.empty() || !is_closed(mesh)) return false;
  const std::vector<std::uint32_t> welded = welded_indices(mesh);
  Groups groups(welded.size());
  for (const glm::uvec3& t : mesh.triangles) {
    groups.join(welded[t.x], welded[t.y]);
    groups.join(welded[t.y], welded[t.z]);
  }
  std::map<std::uint32_t, double> volume;  // six times, signed; about the origin, which a closed part does not notice
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3& a = mesh.positions_m[t.x];
    volume[groups.of(welded[t.x])] += glm::dot(a, glm::cross(mesh.positions_m[t.y], mesh.positions_m[t.z]));
  }
  return std::all_of(volume.begin(), volume.end(), [](const auto& part) { return part.second > 0.0; });
}

}  // namespace focalstage
