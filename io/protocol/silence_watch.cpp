#include "io/protocol/silence_watch.h"

#include <utility>

namespace focalstage {

SilenceWatch::SilenceWatch(Clock::duration limit, std::function<void()> on_silence, std::function<void()> at_start)
    : limit_(limit), on_silence_(std::move(on_silence)) {
  thread_ = std::jthread([this, at_start = std::move(at_start)](const std::stop_token& stop) {
    if (at_start) at_start();
    wait(stop);
  });
}

void SilenceWatch::heard() {
  const std::lock_guard lock(mutex_);
  last_ = Clock::now();
}

bool SilenceWatch::fell_silent() const {
  const std::lock_guard lock(mutex_);
  return silent_;
}

void SilenceWatch::wait(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (Clock::now() < last_ + limit_) {
    // Wakes when the last word heard so far grows old; what was heard since puts that off.
    const Clock::time_point until = last_ + limit_;
    changed_.wait_until(lock, stop, until, [] { return false; });
    if (stop.stop_requested()) return;
  }
  silent_ = true;
  lock.unlock();
  on_silence_();
}

}  // namespace focalstage
