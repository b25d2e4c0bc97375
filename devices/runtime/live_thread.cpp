#include "devices/runtime/live_thread.h"

#include <algorithm>
#include <utility>

#include "devices/roles/clock.h"
#include "io/files/files.h"

namespace focalstage {

namespace {

std::uint64_t revision_of(const LiveChange& change) {
  if (const auto* project = std::get_if<ProjectChange>(&change)) return project->revision;
  if (const auto* edits = std::get_if<EditsChange>(&change)) return edits->revision;
  return 0;
}

}  // namespace

LiveThread::LiveThread(AssetStore& assets, RigTerms rig, LiveResults results)
    : assets_(assets),
      results_(std::move(results)),
      maker_(assets, std::move(rig)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

LiveThread::~LiveThread() {
  thread_.request_stop();
  thread_.join();
}

void LiveThread::add(LiveChange change) {
  const std::lock_guard lock(mutex_);
  // Nothing builds upon what came before a project that is sent anew.
  if (std::holds_alternative<ProjectChange>(change)) changes_.clear();
  changes_.push_back(std::move(change));
  if (in_progress_ && !cancelled_one_) in_progress_->request_stop();
  changed_.notify_all();
}

void LiveThread::add(LiveBlob blob) {
  const std::lock_guard lock(mutex_);
  blobs_.push_back(std::move(blob));
  changed_.notify_all();
}

bool LiveThread::complete(const LiveChange& change) const {
  const auto all_here = [&](const std::vector<LiveFile>& files) {
    return std::ranges::all_of(files, [&](const LiveFile& file) { return assets_.has(file.sha256); });
  };
  if (const auto* project = std::get_if<ProjectChange>(&change)) {
    return text_ && text_->sha256 == project->text_sha256 && all_here(project->files);
  }
  if (const auto* edits = std::get_if<EditsChange>(&change)) return all_here(edits->files);
  return true;
}

bool LiveThread::can_take_in() const { return !blobs_.empty() || (!changes_.empty() && complete(changes_.front())); }

void LiveThread::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [&] { return can_take_in() || stale_; }) && !stop.stop_requested()) {
    if (can_take_in()) {
      take_in(lock);
    } else {
      compile(lock, stop);
    }
  }
}

void LiveThread::take_in(std::unique_lock<std::mutex>& lock) {
  if (!blobs_.empty()) {
    LiveBlob blob = std::move(blobs_.front());
    blobs_.pop_front();
    lock.unlock();
    take_in(std::move(blob));
    lock.lock();
    return;
  }
  const LiveChange change = std::move(changes_.front());
  changes_.pop_front();
  lock.unlock();
  take_in(change);
  lock.lock();
}

/// A project's text stays in memory, an asset goes to the store. One that is not what it was announced as takes the
/// change with it that waits for it.
void LiveThread::take_in(LiveBlob blob) {
  std::unique_lock lock(mutex_);
  const auto* waiting = changes_.empty() ? nullptr : std::get_if<ProjectChange>(&changes_.front());
  const bool is_text = waiting != nullptr && waiting->text_sha256 == blob.sha256;
  lock.unlock();
  Status taken;
  if (!is_text) {
    taken = assets_.add(blob.sha256, blob.bytes);
  } else if (sha256_hex(blob.bytes) != blob.sha256) {
    taken = Fault{"rig.damaged", "project", "its bytes are not those that were announced", "send it again"};
  }
  lock.lock();
  if (taken) {
    if (is_text) text_ = std::move(blob);
    return;
  }
  if (changes_.empty() || complete(changes_.front())) return;
  const std::uint64_t revision = revision_of(changes_.front());
  changes_.pop_front();
  lock.unlock();
  results_.refused(revision, taken.fault());
}

void LiveThread::take_in(const LiveChange& change) {
  Status taken;
  if (const auto* project = std::get_if<ProjectChange>(&change)) {
    taken = book_.begin(*project, text_->bytes);
  } else if (const auto* edits = std::get_if<EditsChange>(&change)) {
    taken = book_.edit(*edits);
  } else {
    taken = book_.show(std::get<FrameChange>(change));
  }
  if (taken) {
    stale_ = true;
    return;
  }
  const std::uint64_t asked = revision_of(change);
  results_.refused(asked > 0 || book_.empty() ? asked : book_.newest().revision, taken.fault());
}

void LiveThread::compile(std::unique_lock<std::mutex>& lock, const std::stop_token& stop) {
  stale_ = false;
  const LiveSnapshot snapshot = book_.newest();
  std::stop_source source;
  in_progress_ = source;
  lock.unlock();
  const std::stop_callback at_the_end(stop, [&] { source.request_stop(); });
  const double started_s = monotonic_s();
  auto made = maker_.make(snapshot, source.get_token());
  const bool cancelled = !made && made.fault().code == "compile.cancelled";
  if (made) {
    results_.made(snapshot, std::move(*made), monotonic_s() - started_s);
  } else if (!cancelled) {
    results_.refused(snapshot.revision, made.fault());
  }
  lock.lock();
  in_progress_.reset();
  cancelled_one_ = cancelled;
  stale_ = stale_ || cancelled;
}

}  // namespace focalstage
