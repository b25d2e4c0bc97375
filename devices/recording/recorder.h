#pragma once

#include <fstream>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "devices/roles/tracker.h"

namespace focalstage {

/// Any tracker, whose frames are written to a file as they come (docs/formats/tracking.md). Asked for a frame or the
/// state it answers what that tracker answers: a disk that is full does not stop tracking.
class TrackerRecorder final : public Tracker {
 public:
  TrackerRecorder(std::shared_ptr<Tracker> tracker, std::string path);
  ~TrackerRecorder() override { stop(); }

  /// Faults: the tracker's own, and "recording.unwritable".
  Status start() override;
  void stop() override;
  std::shared_ptr<const TrackedFrame> newest() const override { return tracker_->newest(); }
  TrackerState state() const override { return tracker_->state(); }

  /// "recording.unwritable" once something could not be written.
  Status written() const;

 private:
  void run(const std::stop_token& stop);
  void write(const TrackedFrame& frame);

  std::shared_ptr<Tracker> tracker_;
  std::string path_;
  mutable std::mutex mutex_;
  std::ofstream file_;
  std::optional<Fault> fault_;
  std::jthread thread_;
};

}  // namespace focalstage
