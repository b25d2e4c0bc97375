#include "core/stage/primitive_cache.h"

#include <algorithm>
#include <cmath>
#include <list>
#include <mutex>
#include <string>
#include <utility>

#include "core/mesh/primitives.h"

namespace focalstage {
namespace {

Mesh make(const FileMesh&) { return {}; }  // a file's meshes are among the assets
Mesh make(const PlaneMesh& shape) { return make_plane(shape.size_m); }
Mesh make(const BoxMesh& shape) { return make_box(shape.size_m); }
Mesh make(const SphereMesh& shape) { return make_sphere(shape.radius_m); }
Mesh make(const CornerMesh& shape) { return make_corner(shape.size_m, shape.angle_deg); }
Mesh make(const StepMesh& shape) { return make_step(shape.size_m, shape.depth_m); }
Mesh make(const TeapotMesh&) { return make_teapot(); }
Mesh make(const RabbitMesh&) { return make_rabbit(); }

constexpr double largest_m = 1e6;  ///< products of three sizes stay far from infinity

bool is_size(double m) { return m > 0.0 && m <= largest_m; }
bool is_size(const glm::dvec2& m) { return is_size(m.x) && is_size(m.y); }
bool is_size(const glm::dvec3& m) { return is_size(m.x) && is_size(m.y) && is_size(m.z); }

/// The key of a number that no mesh can be made of, or null.
const char* wrong_key(const FileMesh&) { return nullptr; }
const char* wrong_key(const TeapotMesh&) { return nullptr; }
const char* wrong_key(const RabbitMesh&) { return nullptr; }
const char* wrong_key(const PlaneMesh& shape) { return is_size(shape.size_m) ? nullptr : "size_m"; }
const char* wrong_key(const BoxMesh& shape) { return is_size(shape.size_m) ? nullptr : "size_m"; }
const char* wrong_key(const SphereMesh& shape) { return is_size(shape.radius_m) ? nullptr : "radius_m"; }
const char* wrong_key(const CornerMesh& shape) {
  if (!is_size(shape.size_m)) return "size_m";
  return shape.angle_deg > 0.0 && shape.angle_deg < 360.0 ? nullptr : "angle_deg";
}
const char* wrong_key(const StepMesh& shape) {
  if (!is_size(shape.size_m)) return "size_m";
  return std::abs(shape.depth_m) <= largest_m ? nullptr : "depth_m";
}

class Cache {
 public:
  std::shared_ptr<const Mesh> find_or_make(const MeshShape& shape) {
    const std::scoped_lock lock(mutex_);
    const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.first == shape; });
    if (found != entries_.end()) {
      entries_.splice(entries_.begin(), entries_, found);
    } else {
      Mesh mesh = std::visit([](const auto& s) { return make(s); }, shape);
      entries_.emplace_front(shape, std::make_shared<const Mesh>(std::move(mesh)));
      if (entries_.size() > most_entries) entries_.pop_back();
    }
    return entries_.front().second;
  }

 private:
  using Entry = std::pair<MeshShape, std::shared_ptr<const Mesh>>;
  static constexpr std::size_t most_entries = 64;

  std::mutex mutex_;
  std::list<Entry> entries_;  ///< the last used first
};

}  // namespace

Result<std::shared_ptr<const Mesh>> primitive_mesh(const MeshShape& shape) {
  if (const char* key = std::visit([](const auto& s) { return wrong_key(s); }, shape)) {
    return Fault{"stage.mesh-size", key, std::string("no mesh can be made with this ") + key,
                 "sizes are above 0 and at most 1e6 m, angles between 0 and 360 degrees"};
  }
  static Cache cache;
  return cache.find_or_make(shape);
}

}  // namespace focalstage
