#pragma once

#include <mutex>
#include <thread>

#include "devices/display/display.h"
#include "devices/display/frame_queue.h"

namespace focalstage {

/// What displays of every kind have in common: frames wait in a queue, and a thread takes them vblank by vblank. What
/// derives from it says how the output is taken and shown, and calls `close` in its own destructor, as the thread works
/// in it.
class QueuedDisplay : public Display {
 public:
  Status open() final;
  void close() final;
  Status post(VideoFrame frame) final { return queue_.post(std::move(frame)); }
  std::size_t waiting() const final { return queue_.waiting(); }
  void black() noexcept final { queue_.forget(); }
  DisplayReport report() const final { return queue_.report(); }

 protected:
  explicit QueuedDisplay(std::size_t most_waiting) : queue_(most_waiting) {}

  /// Takes the output, shows black, opens the queue and gives back the thread that shows what is in it until it is
  /// asked to stop, or loses the queue.
  virtual Result<std::jthread> take() = 0;
  /// Gives the output back. The thread is through; also called where nothing was taken.
  virtual void give_back() {}

  FrameQueue queue_;

 private:
  void end();

  std::mutex opening_;
  std::jthread thread_;
};

}  // namespace focalstage
