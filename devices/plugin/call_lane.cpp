#include "devices/plugin/call_lane.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

#include "devices/roles/clock.h"

namespace focalstage {

namespace {

constexpr double farewell_s = 0.1;

std::chrono::duration<double> seconds(double s) { return std::chrono::duration<double>(s); }

}  // namespace

struct CallLane::Shared {
  struct Call {
    std::function<void()> made;
    double due_s = 0.0;
  };

  mutable std::mutex mutex;
  mutable std::condition_variable changed;
  std::deque<Call> waiting;
  bool busy = false;
  double due_at_s = 0.0;  ///< of the call under way, on the monotonic clock
  bool ending = false;
  bool ended = false;

  bool still() const { return waiting.empty() && !busy; }
};

CallLane::CallLane() : shared_(std::make_shared<Shared>()) {
  std::thread([shared = shared_] { work(shared); }).detach();
}

CallLane::~CallLane() {
  std::unique_lock lock(shared_->mutex);
  shared_->ending = true;
  shared_->waiting.clear();
  shared_->changed.notify_all();
  shared_->changed.wait_for(lock, seconds(farewell_s), [this] { return shared_->ended; });
}

void CallLane::work(const std::shared_ptr<Shared>& shared) {
  std::unique_lock lock(shared->mutex);
  while (true) {
    shared->changed.wait(lock, [&] { return shared->ending || !shared->waiting.empty(); });
    if (shared->ending) break;
    {
      const Shared::Call call = std::move(shared->waiting.front());
      shared->waiting.pop_front();
      shared->busy = true;
      shared->due_at_s = monotonic_s() + call.due_s;
      lock.unlock();
      call.made();
    }  // what it owns goes before it counts as done
    lock.lock();
    shared->busy = false;
    shared->changed.notify_all();
  }
  shared->ended = true;
  shared->changed.notify_all();
}

void CallLane::post(std::function<void()> call, double due_s) {
  const std::lock_guard lock(shared_->mutex);
  shared_->waiting.push_back({std::move(call), due_s});
  shared_->changed.notify_all();
}

bool CallLane::run(std::function<void()> call, double due_s, double wait_s) {
  struct Done {
    std::mutex mutex;
    std::condition_variable changed;
    bool done = false;
  };
  const auto done = std::make_shared<Done>();
  post(
      [done, call = std::move(call)] {
        call();
        const std::lock_guard lock(done->mutex);
        done->done = true;
        done->changed.notify_all();
      },
      due_s);
  std::unique_lock lock(done->mutex);
  return done->changed.wait_for(lock, seconds(wait_s), [&] { return done->done; });
}

void CallLane::forget() {
  const std::lock_guard lock(shared_->mutex);
  shared_->waiting.clear();
  shared_->changed.notify_all();
}

bool CallLane::idle(double wait_s) const {
  std::unique_lock lock(shared_->mutex);
  return shared_->changed.wait_for(lock, seconds(wait_s), [this] { return shared_->still(); });
}

double CallLane::overdue_s() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->busy ? std::max(0.0, monotonic_s() - shared_->due_at_s) : 0.0;
}

}  // namespace focalstage
