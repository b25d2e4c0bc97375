#include "editor/cli/interrupt.h"

#include <pthread.h>
#include <unistd.h>

#include <chrono>
#include <ctime>

namespace focalstage {
namespace {

constexpr std::chrono::milliseconds orderly_end{150};
constexpr long poll_ns = 20'000'000;

}  // namespace

Interrupt::Interrupt() {
  sigemptyset(&watched_);
  sigaddset(&watched_, SIGINT);
  sigaddset(&watched_, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &watched_, &before_);
  watcher_ = std::thread([this] { watch(); });
}

Interrupt::~Interrupt() {
  {
    const std::lock_guard lock(mutex_);
    finished_ = true;
  }
  finished_changed_.notify_all();
  watcher_.join();
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void Interrupt::watch() {
  const timespec poll{0, poll_ns};
  for (;;) {
    const int signal = sigtimedwait(&watched_, nullptr, &poll);
    std::unique_lock lock(mutex_);
    if (finished_) return;
    if (signal <= 0) continue;
    signal_ = signal;
    stop_.request_stop();
    if (!finished_changed_.wait_for(lock, orderly_end, [this] { return finished_; })) end_by(signal);
    return;
  }
}

void Interrupt::end_if_asked() {
  if (signal_ != 0) end_by(signal_);
}

void Interrupt::end_by(int signal) {
  std::signal(signal, SIG_DFL);
  pthread_sigmask(SIG_UNBLOCK, &watched_, nullptr);
  kill(getpid(), signal);
  pause();
}

}  // namespace focalstage
