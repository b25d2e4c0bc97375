#include "devices/recording/recorder.h"

#include <chrono>
#include <system_error>
#include <utility>

#include "devices/recording/recording_text.h"

namespace focalstage {

namespace {

// How often a new frame is looked for: trackers come to a few hundred frames a second.
constexpr std::chrono::milliseconds tick{1};
// Frames between flushes: what a crash may take with it.
constexpr int frames_per_flush = 100;

}  // namespace

TrackerRecorder::TrackerRecorder(std::shared_ptr<Tracker> tracker, std::string path)
    : tracker_(std::move(tracker)), path_(std::move(path)) {}

Status TrackerRecorder::start() {
  if (thread_.joinable()) return {};
  const Fault unwritable{"recording.unwritable", path_, "the file can't be written", "choose another place"};
  {
    const std::lock_guard lock(mutex_);
    fault_.reset();
    file_.open(path_, std::ios::binary | std::ios::trunc);
    if (!(file_ << recording_head() << std::flush)) {
      file_.close();
      return unwritable;
    }
  }
  if (Status started = tracker_->start(); !started) return started;
  try {
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  } catch (const std::system_error& error) {
    return Fault{"recording.thread", path_, std::string("no thread can be had: ") + error.what(), ""};
  }
  return {};
}

void TrackerRecorder::stop() {
  if (thread_.joinable()) {
    thread_.request_stop();
    thread_.join();
  }
  tracker_->stop();
  const std::lock_guard lock(mutex_);
  file_.close();
}

Status TrackerRecorder::written() const {
  const std::lock_guard lock(mutex_);
  if (fault_) return *fault_;
  return {};
}

void TrackerRecorder::run(const std::stop_token& stop) {
  std::shared_ptr<const TrackedFrame> last;
  int since_flush = 0;
  while (!stop.stop_requested()) {
    const auto frame = tracker_->newest();
    if (frame && frame != last) {
      write(*frame);
      last = frame;
      if (++since_flush == frames_per_flush) {
        file_.flush();
        since_flush = 0;
      }
    }
    std::this_thread::sleep_for(tick);
  }
}

void TrackerRecorder::write(const TrackedFrame& frame) {
  const std::lock_guard lock(mutex_);
  if (fault_ || (file_ << recording_lines(frame))) return;
  fault_ = Fault{"recording.unwritable", path_, "the disk is full or failed: the recording ends here",
                 "free some space, then record anew"};
}

}  // namespace focalstage
