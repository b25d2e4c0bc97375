#include "core/stage/deformed_meshes.h"

#include <algorithm>
#include <list>
#include <mutex>
#include <utility>

#include "core/mesh/deform.h"

namespace focalstage {
namespace {

/// The deformed meshes that are in somebody's hands. It holds none itself: a show's frames are not kept for it.
class Known {
 public:
  std::shared_ptr<const Mesh> find(const ModelPart& part, const Deformed& state) {
    const std::scoped_lock lock(mutex_);
    std::erase_if(entries_, [](const Entry& entry) { return entry.mesh.expired(); });
    for (const Entry& entry : entries_) {
      if (entry.from.lock() != part.mesh || entry.deformation.lock() != part.deformation) continue;
      if (entry.state == state) return entry.mesh.lock();
    }
    return nullptr;
  }

  void keep(const ModelPart& part, Deformed state, const std::shared_ptr<const Mesh>& mesh) {
    const std::scoped_lock lock(mutex_);
    entries_.push_front({part.mesh, part.deformation, std::move(state), mesh});
    if (entries_.size() > most_entries) entries_.pop_back();
  }

 private:
  struct Entry {
    std::weak_ptr<const Mesh> from;
    std::weak_ptr<const Deformation> deformation;
    Deformed state;
    std::weak_ptr<const Mesh> mesh;
  };
  static constexpr std::size_t most_entries = 1024;

  std::mutex mutex_;
  std::list<Entry> entries_;  ///< the newest first
};

}  // namespace

std::shared_ptr<const Mesh> deformed_mesh(const ModelPart& part, Deformed state) {
  const bool as_it_is =
      state.mesh_from_joints.empty() &&
      std::all_of(state.morph_weights.begin(), state.morph_weights.end(), [](double w) { return w == 0.0; });
  if (as_it_is) return part.mesh;
  static Known known;
  if (std::shared_ptr<const Mesh> mesh = known.find(part, state)) return mesh;
  auto mesh = std::make_shared<const Mesh>(
      deformed(*part.mesh, *part.deformation, state.morph_weights, state.mesh_from_joints));
  known.keep(part, std::move(state), mesh);
  return mesh;
}

}  // namespace focalstage
