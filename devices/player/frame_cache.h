#pragma once

#include <condition_variable>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "core/base/result.h"
#include "core/compile/frame.h"
#include "devices/player/prepared_frames.h"
#include "devices/player/priority_mutex.h"

namespace focalstage {

/// Where the images of a show come from. Asked by one thread at a time.
class FrameSource {
 public:
  FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;
  virtual ~FrameSource() = default;

  virtual Result<FrameImages> frame(int frame) = 0;
};

/// Reads frames before they are needed, in a thread of its own, and keeps as many as memory allows.
class FrameCache final : public PreparedFrames {
 public:
  FrameCache(std::unique_ptr<FrameSource> source, int frames, std::size_t bytes_per_frame,
             std::size_t budget_bytes = std::size_t{384} << 20);

  Result<Frame> get(int frame) override;
  Result<Frame> wait_for(int frame) override;
  bool prepare(int frame) override;

 private:
  void read_ahead(const std::stop_token& stop);
  std::optional<int> next_missing() const;
  void forget_far_frames();
  int distance_ahead(int frame) const;

  std::unique_ptr<FrameSource> source_;
  int frames_;
  int kept_;
  mutable PriorityMutex mutex_;
  std::condition_variable_any changed_;
  int wanted_ = 0;
  std::optional<int> prepared_;
  std::map<int, Frame> ready_;
  std::map<int, Fault> failed_;
  std::jthread reader_;
};

}  // namespace focalstage
