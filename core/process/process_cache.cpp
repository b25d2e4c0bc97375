#include <algorithm>
#include <list>
#include <mutex>

#include "core/process/process.h"

namespace focalstage {

namespace {

/// What was made of meshes that still live. Entries hold their mesh, so that no other can come to its address.
class Cache {
 public:
  Result<std::shared_ptr<const Mesh>> find_or_make(const std::shared_ptr<const Mesh>& mesh,
                                                   const std::vector<ProcessStep>& steps) {
    const std::shared_ptr<Entry> entry = find_or_add(mesh, steps);
    const std::scoped_lock lock(entry->making);
    if (!entry->made) {
      Result<Mesh> made = processed(*mesh, steps);
      entry->made = made ? Made(std::make_shared<const Mesh>(*std::move(made))) : Made(made.fault());
    }
    return *entry->made;
  }

 private:
  using Made = Result<std::shared_ptr<const Mesh>>;
  struct Entry {
    std::shared_ptr<const Mesh> mesh;
    std::vector<ProcessStep> steps;
    std::mutex making;
    std::optional<Made> made;
  };
  static constexpr std::size_t most_entries = 64;

  std::shared_ptr<Entry> find_or_add(const std::shared_ptr<const Mesh>& mesh, const std::vector<ProcessStep>& steps) {
    const std::scoped_lock lock(mutex_);
    const auto found =
        std::ranges::find_if(entries_, [&](const auto& entry) { return entry->mesh == mesh && entry->steps == steps; });
    if (found != entries_.end()) {
      entries_.splice(entries_.begin(), entries_, found);
    } else {
      entries_.push_front(std::make_shared<Entry>());
      entries_.front()->mesh = mesh;
      entries_.front()->steps = steps;
      if (entries_.size() > most_entries) entries_.pop_back();
    }
    return entries_.front();
  }

  std::mutex mutex_;
  std::list<std::shared_ptr<Entry>> entries_;  ///< the last used first
};

}  // namespace

Result<std::shared_ptr<const Mesh>> processed_once(const std::shared_ptr<const Mesh>& mesh,
                                                   const std::vector<ProcessStep>& steps) {
  if (steps.empty()) return mesh;
  static Cache cache;
  return cache.find_or_make(mesh, steps);
}

}  // namespace focalstage
