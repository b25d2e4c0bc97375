#pragma once

#include <algorithm>
#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace focalstage {

/// The last values that were asked for, each made once by whoever asks first; others who ask meanwhile wait. Any
/// thread.
template <class Key, class Made>
class MadeOnce {
 public:
  explicit MadeOnce(std::size_t most) : most_(most) {}

  template <class Make>
  Made find_or_make(const Key& key, Make&& make) {
    const std::shared_ptr<Entry> entry = find_or_add(key);
    const std::scoped_lock lock(entry->making);
    if (!entry->made) entry->made.emplace(make());
    return *entry->made;
  }

 private:
  struct Entry {
    explicit Entry(const Key& asked) : key(asked) {}
    Key key;
    std::mutex making;
    std::optional<Made> made;
  };

  std::shared_ptr<Entry> find_or_add(const Key& key) {
    const std::scoped_lock lock(mutex_);
    const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const auto& e) { return e->key == key; });
    if (found != entries_.end()) {
      entries_.splice(entries_.begin(), entries_, found);
    } else {
      entries_.push_front(std::make_shared<Entry>(key));
      if (entries_.size() > most_) entries_.pop_back();
    }
    return entries_.front();
  }

  std::size_t most_;
  std::mutex mutex_;
  std::list<std::shared_ptr<Entry>> entries_;  ///< the last used first
};

}  // namespace focalstage
