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

namespace focalstage {

/// A blob that arrived, not yet held against its name.
struct LiveBlob {
  std::string sha256;
  std::string bytes;
};

/// What comes of changes.
struct LiveResults {
  /// A frame to be shown, and how long making it took. Takes the show over.
  std::function<void(const LiveSnapshot&, std::shared_ptr<LoadedShow>, double compile_s)> made;
  std::function<void(std::uint64_t revision, const Fault&)> refused;
};

/// Takes changes in order and compiles what is newest, in a thread of its own. What is being compiled when something
/// newer comes is cancelled, but never two in a row: a drag that outruns the compiler still moves on the rig.
class LiveThread {
 public:
  LiveThread(AssetStore& assets, RigTerms rig, LiveResults results);
  ~LiveThread();

  void add(LiveChange change);
  void add(LiveBlob blob);

 private:
  void run(const std::stop_token& stop);
  bool can_take_in() const;
  bool complete(const LiveChange& change) const;
  void take_in(std::unique_lock<std::mutex>& lock);
  void take_in(LiveBlob blob);
  void take_in(const LiveChange& change);
  void compile(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);

  AssetStore& assets_;
  LiveResults results_;
  LiveBook book_;    // of the thread alone
  LiveMaker maker_;  // of the thread alone

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
