#pragma once

#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "editor/session/task.h"

namespace focalstage {

/// Work behind the window, each on a thread of its own, finished on the window's: a job returns what is to be done with
/// its result, and `finish` does it.
class Jobs {
 public:
  using Finish = std::function<void()>;
  using Progress = std::function<void(double share, const std::string& detail)>;
  using Work = std::function<Finish(const Progress&, std::stop_token)>;

  explicit Jobs(std::function<void()> wake) : wake_(std::move(wake)) {}
  ~Jobs();

  /// `quiet`: as the Task says.
  void start(std::string title, Work work, bool quiet = false);
  void cancel(int id);

  /// Does what finished jobs returned. True if there was anything to do or progress was made.
  bool finish();

  /// Those still running.
  const std::vector<Task>& tasks() const { return shown_; }

 private:
  struct Job {
    Task task;
    bool done = false;
    bool moved = true;
    Finish finish;
    std::jthread thread;
  };

  std::function<void()> wake_;
  std::mutex mutex_;
  std::list<Job> jobs_;
  std::vector<Task> shown_;
  int next_id_ = 1;
};

}  // namespace focalstage
