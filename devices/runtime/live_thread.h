#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "devices/runtime/live_book.h"
#include "devices/runtime/live_changes.h"
#include "devices/runtime/live_maker.h"
#include "devices/runtime/live_tracking.h"

namespace focalstage {

/// A blob that arrived, not yet held against its name.
struct LiveBlob {
  std::string sha256;
  std::string bytes;
};

/// A frame to be shown.
struct LiveMade {
  std::shared_ptr<LoadedShow> show;
  double compile_s = 0.0;
  bool first = true;                  ///< of this revision and frame; else only bodies moved
  std::optional<PosedProject> posed;  ///< where bodies are part of it
};

/// What comes of changes.
struct LiveResults {
  std::function<void(const LiveSnapshot&, LiveMade)> made;
  std::function<void(std::uint64_t revision, const Fault&)> refused;
};

/// What was said of a revision: once is enough.
struct LiveTold {
  std::uint64_t revision = 0;
  int frame = 0;
  double received_s = 0.0;
  std::string refusal;  ///< code; empty: made

  bool operator==(const LiveTold&) const = default;
};

/// Takes changes in order and compiles what is newest, in a thread of its own. What is being compiled when something
/// newer comes is cancelled, but never two in a row: a drag that outruns the compiler still moves on the rig. Where
/// things are tracked the newest revision is compiled again as bodies move, once per sweep at most.
class LiveThread {
 public:
  /// `tracking`: null on a rig without a tracker.
  LiveThread(AssetStore& assets, RigTerms rig, const LiveTracking* tracking, LiveResults results);
  ~LiveThread();

  void add(LiveChange change);
  void add(LiveBlob blob);

 private:
  void run(const std::stop_token& stop);
  bool wait(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);
  bool pose_is_due() const;
  bool can_take_in() const;
  bool complete(const LiveChange& change) const;
  void take_in(std::unique_lock<std::mutex>& lock);
  void take_in(LiveBlob blob);
  void take_in(const LiveChange& change);
  void compile(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);
  Result<LiveMade> make(LiveSnapshot snapshot, const std::stop_token& stop);
  void tell(const LiveSnapshot& snapshot, Result<LiveMade> made);

  AssetStore& assets_;
  const LiveTracking* tracking_;
  LiveResults results_;

  // Of the thread alone:
  LiveBook book_;
  LiveMaker maker_;
  bool follows_ = false;          ///< the newest revision has tracked things
  std::uint64_t posed_ = 0;       ///< the tracker's frame that was compiled last
  double next_pose_s_ = 0.0;      ///< not before that is it compiled again
  std::optional<LiveTold> told_;  ///< what was said last

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<LiveChange> changes_;
  std::deque<LiveBlob> blobs_;
  std::optional<LiveBlob> text_;                 ///< of the project that waits for it
  std::optional<std::stop_source> in_progress_;  ///< of the compile
  bool cancelled_one_ = false;                   ///< the compile before was cancelled: this one is not
  bool stale_ = false;                           ///< the newest revision or frame is not compiled yet
  std::jthread thread_;
};

}  // namespace focalstage
