#include "devices/lightcrafter/command_thread.h"

#include <chrono>

namespace focalstage::lightcrafter {

namespace {

constexpr int most_silences = 2;

std::chrono::duration<double> seconds(double value) { return std::chrono::duration<double>(value); }

}  // namespace

CommandThread::CommandThread(std::unique_ptr<Reports> reports, const LightCrafterSettings& settings, Looked looked,
                             Lost lost)
    : control_(std::move(reports), settings, hurry_),
      poll_s_(settings.poll_s),
      looked_(std::move(looked)),
      lost_(std::move(lost)),
      thread_([this](const std::stop_token& stop) { loop(stop); }) {}

CommandThread::~CommandThread() {
  thread_.request_stop();
  hurry_ = true;
  thread_.join();
}

Status CommandThread::run(Job job, double within_s) {
  const auto task = std::make_shared<Task>();
  task->job = std::move(job);
  std::unique_lock lock(mutex_);
  if (fault_) return *fault_;
  tasks_.push_back(task);
  changed_.notify_all();
  if (!changed_.wait_for(lock, seconds(within_s), [&] { return task->done; })) {
    std::erase(tasks_, task);
    return Fault{"projector.silent", "LightCrafter 4500", "it did not do what it was told in time",
                 "switch it off and on, then open it again"};
  }
  return task->result;
}

bool CommandThread::dark(double within_s) noexcept {
  std::unique_lock lock(mutex_);
  if (fault_) return false;
  const std::uint64_t mine = ++dark_asked_;
  hurry_ = true;
  changed_.notify_all();
  return changed_.wait_for(lock, seconds(within_s), [&] { return dark_done_ >= mine || fault_; }) && dark_heard_ &&
         !fault_;
}

void CommandThread::loop(const std::stop_token& stop) {
  const auto until_next_look = [&] { return std::chrono::steady_clock::now() + seconds(poll_s_); };
  auto look_at = until_next_look();
  while (!stop.stop_requested()) {
    std::shared_ptr<Task> task;
    bool darken = false;
    {
      std::unique_lock lock(mutex_);
      changed_.wait_until(lock, stop, look_at, [&] { return dark_asked_ > dark_done_ || !tasks_.empty(); });
      if (stop.stop_requested()) break;
      darken = dark_asked_ > dark_done_;
      if (!darken && !tasks_.empty()) {
        task = tasks_.front();
        tasks_.pop_front();
      }
    }
    if (darken) {
      make_dark();
    } else if (task) {
      do_task(task);
    } else {
      look();
      look_at = until_next_look();
    }
  }
  hurry_ = false;
  (void)control_.dark();
}

void CommandThread::make_dark() {
  std::uint64_t asked = 0;
  {
    const std::lock_guard lock(mutex_);
    asked = dark_asked_;
    hurry_ = false;
    for (const auto& task : tasks_) {
      task->result = Fault{"projector.hurried", "LightCrafter 4500", "it was told to go dark instead", ""};
      task->done = true;
    }
    tasks_.clear();
  }
  const bool heard = control_.dark();
  const std::lock_guard lock(mutex_);
  dark_done_ = asked;
  dark_heard_ = heard;
  changed_.notify_all();
}

void CommandThread::do_task(const std::shared_ptr<Task>& task) {
  Status result;
  {
    const std::lock_guard lock(mutex_);
    if (fault_) result = *fault_;
  }
  if (result) result = task->job(control_);
  if (!result && result.fault().code == "projector.lost") lose(result.fault());
  const std::lock_guard lock(mutex_);
  task->result = std::move(result);
  task->done = true;
  changed_.notify_all();
}

void CommandThread::look() {
  {
    const std::lock_guard lock(mutex_);
    if (fault_) return;
  }
  const Result<BoardState> state = control_.look();
  if (state) {
    silences_ = 0;
    if (looked_(*state)) (void)control_.dark();
    return;
  }
  if (state.fault().code == "projector.hurried") return;
  if (state.fault().code == "projector.lost" || ++silences_ >= most_silences) lose(state.fault());
}

void CommandThread::lose(const Fault& fault) {
  {
    const std::lock_guard lock(mutex_);
    if (fault_) return;
    fault_ = fault;
    changed_.notify_all();
  }
  lost_(fault);
  (void)control_.dark();  // in case that it hears, though it does not answer
}

}  // namespace focalstage::lightcrafter
