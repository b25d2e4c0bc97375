#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scene/edit.h"
#include "io/assets/assets.h"
#include "io/protocol/client.h"
#include "io/protocol/live_values.h"

namespace focalstage {

/// A project as a live link begins with it.
struct LiveProject {
  std::uint64_t revision = 1;  ///< above 0, and above every one before it
  std::string text;            ///< of the project file (project_text)
  std::vector<AssetFile> files;
  int frame = 0;
};

/// The editor's hand on a rig that compiles and shows what it edits. Sends from a thread of its own and says every
/// 40 ms that this program lives; nothing here waits for the rig, but `start`.
///
/// The rig shows what it gets once it was told to play (RigClient); darkness needs its `go` as ever. At the end what
/// plays stays; if this program vanishes instead, the rig goes dark. The lease is the client's, and lasts as long as
/// the link does.
class LiveLink {
 public:
  /// "rig.held", "rig.refused" (a link is open already), "rig.unreachable".
  static Result<LiveLink> start(RigClient& rig, LiveProject project, bool share_frames = false);

  LiveLink(LiveLink&&) noexcept;
  LiveLink& operator=(LiveLink&&) noexcept;
  ~LiveLink();  ///< says that it ends

  /// The revision that `edits` make of the last one sent; `new_files` are those that only they refer to.
  /// "live.too-large" where a project had to be sent; after the end of the link, why it ended.
  Status send(std::uint64_t revision, const std::vector<Edit>& edits, std::vector<AssetFile> new_files = {});

  /// The same, on an earlier base: what undo does, with no edits. The rig knows the last 64 revisions.
  Status send_onto(std::uint64_t base_revision, std::uint64_t revision, const std::vector<Edit>& edits,
                   std::vector<AssetFile> new_files = {});

  /// A project anew; of its files only those travel that the rig has not got.
  Status send_project(LiveProject project);

  /// Frame `frame` of the project is shown from now on.
  Status show_frame(int frame);

  /// What was answered since the last call, in order; of states only the newest. Never waits.
  std::vector<LiveAnswer> poll();

 private:
  struct State;
  explicit LiveLink(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace focalstage
