#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <string>

#include "focalstage/v1/rig.pb.h"
#include "io/files/shared_bytes.h"

namespace focalstage {

/// What a live link offers by hash, and the chunks of what was asked for. For one thread at a time.
class LiveBlobs {
 public:
  void offer(const std::string& sha256, SharedBytes bytes);

  /// Not to be had any more, also where its chunks were under way.
  void withdraw(const std::string& sha256);

  /// The other side lacks it: its chunks come next. What was never offered is passed over.
  void ask(const std::string& sha256);

  bool has_chunk() const { return !asked_.empty(); }
  v1::LiveChunk next_chunk();

 private:
  std::map<std::string, SharedBytes> offered_;
  std::deque<std::string> asked_;
  std::size_t sent_bytes_ = 0;  ///< of the first one asked for
};

}  // namespace focalstage
