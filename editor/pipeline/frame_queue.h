#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "core/base/result.h"
#include "core/compile/frame.h"
#include "io/show/writer.h"

namespace focalstage {

/// Writes frames behind the back of who compiles them: a thread of its own and a short queue, so that memory stays
/// bounded however long the show.
class FrameQueue {
 public:
  explicit FrameQueue(ShowWriter& writer);
  ~FrameQueue();
  FrameQueue(const FrameQueue&) = delete;
  FrameQueue& operator=(const FrameQueue&) = delete;

  /// Waits while the queue is full. A fault of the writer ends it: this and every later call returns it.
  Status add(int frame, std::shared_ptr<const FrameImages> images, const FrameMeasure& measure,
             std::size_t projector = 0);

  /// Waits until all is written.
  Status drain();

 private:
  struct Item {
    int frame;
    std::shared_ptr<const FrameImages> images;
    FrameMeasure measure;
    std::size_t projector;
  };

  void run();

  ShowWriter& writer_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Item> items_;
  bool writing_ = false;
  bool closed_ = false;
  std::optional<Fault> fault_;
  std::thread thread_;
};

}  // namespace focalstage
