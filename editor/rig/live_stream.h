#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "editor/rig/rig_link.h"
#include "io/protocol/live_client.h"

namespace focalstage {

/// Keeps a rig showing the newest revision: sends what changed since the last one it was sent.
class LiveStream {
 public:
  bool open() const { return link_.has_value(); }

  /// Begins with `wish`. Faults of LiveLink, and of reading the project's files.
  Status start(RigClient& rig, const LiveWish& wish);
  void stop() { link_.reset(); }

  /// Sends what differs from the last wish, if anything.
  Status show(const LiveWish& wish);

  /// Whether the rig compiled the first revision since `start`: from then on it has something to play. Once.
  bool take_ready() { return std::exchange(ready_, false); }

  /// What the rig answered since; the link is closed where it says that it ended. True if `status` changed.
  bool take_answers(RigStatus& status);

 private:
  std::optional<LiveLink> link_;
  LiveWish sent_;
  bool compiled_ = false;  ///< any revision since the start
  bool ready_ = false;
  std::set<std::string> sent_files_;  ///< by hash
};

}  // namespace focalstage
