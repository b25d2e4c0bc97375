#include "editor/session/jobs.h"

#include <utility>

namespace focalstage {

Jobs::~Jobs() {
  for (Job& job : jobs_) job.thread.request_stop();
  for (Job& job : jobs_) {
    if (job.thread.joinable()) job.thread.join();
  }
}

void Jobs::start(std::string title, Work work, bool quiet) {
  const std::lock_guard lock(mutex_);
  Job& job = jobs_.emplace_back();
  job.task = {next_id_++, std::move(title), -1.0, {}, quiet};
  shown_.push_back(job.task);
  job.thread = std::jthread([this, &job, work = std::move(work)](std::stop_token stop) {
    const Progress progress = [&](double share, const std::string& detail) {
      {
        const std::lock_guard inner(mutex_);
        job.task.share = share;
        job.task.detail = detail;
        job.moved = true;
      }
      wake_();
    };
    Finish finish = work(progress, std::move(stop));
    {
      const std::lock_guard inner(mutex_);
      job.finish = std::move(finish);
      job.done = true;
    }
    wake_();
  });
}

void Jobs::cancel(int id) {
  const std::lock_guard lock(mutex_);
  for (Job& job : jobs_) {
    if (job.task.id == id) job.thread.request_stop();
  }
}

bool Jobs::finish() {
  std::list<Job> done;
  bool moved = false;
  {
    const std::lock_guard lock(mutex_);
    for (auto at = jobs_.begin(); at != jobs_.end();) {
      const auto next = std::next(at);
      moved = moved || at->moved;
      at->moved = false;
      if (at->done) done.splice(done.end(), jobs_, at);
      at = next;
    }
    shown_.clear();
    for (const Job& job : jobs_) shown_.push_back(job.task);
  }
  for (Job& job : done) {
    job.thread.join();
    if (job.finish) job.finish();
  }
  return moved || !done.empty();
}

}  // namespace focalstage
