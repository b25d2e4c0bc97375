#include "editor/tools/known_bounds.h"

#include <unordered_map>

namespace focalstage {
namespace {

struct Known {
  std::weak_ptr<const Mesh> mesh;  ///< an address may come again once its mesh is gone
  Bounds bounds;
};

constexpr std::size_t most_known = 4096;

}  // namespace

const Bounds& known_bounds(const std::shared_ptr<const Mesh>& mesh) {
  thread_local std::unordered_map<const Mesh*, Known> known;
  const auto found = known.find(mesh.get());
  if (found != known.end() && found->second.mesh.lock() == mesh) return found->second.bounds;
  if (known.size() >= most_known) {
    std::erase_if(known, [](const auto& item) { return item.second.mesh.expired(); });
  }
  return known.insert_or_assign(mesh.get(), Known{mesh, mesh_bounds(*mesh)}).first->second.bounds;
}

Bounds rough_world_bounds(const std::vector<Drawable>& drawables) {
  Bounds all;
  for (const Drawable& drawable : drawables) {
    const Bounds& own = known_bounds(drawable.mesh);
    for (unsigned i = 0; i < 8 && !own.empty(); ++i) {
      const glm::dvec3 corner{(i & 1u) != 0 ? own.max_m.x : own.min_m.x, (i & 2u) != 0 ? own.max_m.y : own.min_m.y,
                              (i & 4u) != 0 ? own.max_m.z : own.min_m.z};
      all.include(glm::dvec3(drawable.world_from_mesh * glm::dvec4(corner, 1.0)));
    }
  }
  return all;
}

}  // namespace focalstage
