#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/scene/project.h"
#include "devices/runtime/live_changes.h"

namespace focalstage {

/// One revision of a live project, and the frame of it that is wanted.
struct LiveSnapshot {
  std::uint64_t revision = 0;
  double received_s = 0.0;
  int frame = 0;
  std::shared_ptr<const Project> project;
  std::map<std::string, std::string> files;  ///< hashes by path
};

/// The revisions of a live project that later ones may build upon. Revisions only grow; a change that is refused leaves
/// everything as it was.
class LiveBook {
 public:
  static constexpr std::size_t kept_revisions = 64;

  /// "live.order", or what is wrong with the text.
  Status begin(const ProjectChange& change, std::string_view text);

  /// "live.order", "live.base" (not among those kept), "json.*" and "edit.*" with the place.
  Status edit(const EditsChange& change);

  /// "live.frame" where the newest revision has no such frame.
  Status show(const FrameChange& change);

  bool empty() const { return revisions_.empty(); }

  /// The newest revision that was taken.
  const LiveSnapshot& newest() const { return revisions_.rbegin()->second; }

 private:
  Status check_order(std::uint64_t revision);
  void keep(LiveSnapshot snapshot);

  std::map<std::uint64_t, LiveSnapshot> revisions_;
  std::uint64_t last_seen_ = 0;
};

}  // namespace focalstage
