#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "devices/lightcrafter/control.h"

namespace focalstage::lightcrafter {

/// The one thread that speaks with a board: it does what it is told in turn, looks at the status in between, and drops
/// everything for darkness.
class CommandThread {
 public:
  using Job = std::function<Status(Control&)>;
  /// Of each look; true: make it dark.
  using Looked = std::function<bool(const BoardState&)>;
  /// Once, when nothing more can be said to it.
  using Lost = std::function<void(const Fault&)>;

  CommandThread(std::unique_ptr<Reports> reports, const LightCrafterSettings& settings, Looked looked, Lost lost);
  /// Ends in darkness if that can be said.
  ~CommandThread();
  CommandThread(const CommandThread&) = delete;
  CommandThread& operator=(const CommandThread&) = delete;

  /// Does this and waits for it, `within_s` at most. Captures of `job` must hold what they need: it may outlast the
  /// wait.
  Status run(Job job, double within_s);

  /// Cuts short what is under way, forgets what waits, and says it; true: it was said and heard within that time.
  bool dark(double within_s) noexcept;

 private:
  struct Task {
    Job job;
    bool done = false;
    Status result;
  };

  void loop(const std::stop_token& stop);
  void make_dark();
  void do_task(const std::shared_ptr<Task>& task);
  void look();
  void lose(const Fault& fault);

  std::atomic<bool> hurry_ = false;
  Control control_;
  double poll_s_;
  Looked looked_;
  Lost lost_;

  std::mutex mutex_;  ///< held for moments only
  std::condition_variable_any changed_;
  std::deque<std::shared_ptr<Task>> tasks_;
  std::uint64_t dark_asked_ = 0;
  std::uint64_t dark_done_ = 0;
  bool dark_heard_ = false;
  std::optional<Fault> fault_;
  int silences_ = 0;
  std::jthread thread_;
};

}  // namespace focalstage::lightcrafter
