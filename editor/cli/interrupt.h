#pragma once

#include <atomic>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <stop_token>
#include <thread>

namespace focalstage {

/// While it lives, Ctrl-C and SIGTERM become a stop request. Who does not stop in time is ended by the signal itself,
/// so that the program is gone within 200 ms whatever it was doing; files are only ever replaced whole, so nothing
/// half-written remains. Make it before any thread: threads inherit that the signals are not theirs.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  std::stop_token token() const { return stop_.get_token(); }

  /// If a signal came, ends the program by it, as the shell expects.
  void end_if_asked();

 private:
  void watch();
  void end_by(int signal);

  std::stop_source stop_;
  std::atomic<int> signal_{0};
  std::mutex mutex_;
  std::condition_variable finished_changed_;
  bool finished_ = false;
  sigset_t watched_{};
  sigset_t before_{};
  std::thread watcher_;
};

}  // namespace focalstage
