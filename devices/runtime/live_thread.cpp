#include "devices/runtime/live_thread.h"

#include <algorithm>
#include <chrono>
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

// How often a newer pose is looked for once it may be compiled.
constexpr std::chrono::milliseconds pose_tick{1};

}  // namespace

LiveThread::LiveThread(AssetStore& assets, RigTerms rig, const LiveTracking* tracking, LiveResults results)
    : assets_(assets),
      tracking_(tracking),
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
  while (wait(lock, stop)) {
    if (can_take_in()) {
      take_in(lock);
    } else {
      compile(lock, stop);
    }
  }
}

/// Until there is something to take in or to compile; false: it is to end.
bool LiveThread::wait(std::unique_lock<std::mutex>& lock, const std::stop_token& stop) {
  const auto has_work = [&] { return can_take_in() || stale_; };
  if (!follows_) return changed_.wait(lock, stop, has_work) && !stop.stop_requested();
  while (!stop.stop_requested()) {
    stale_ = stale_ || pose_is_due();
    if (changed_.wait_for(lock, stop, pose_tick, has_work)) break;
  }
  return !stop.stop_requested();
}

bool LiveThread::pose_is_due() const {
  return tracking_ != nullptr && monotonic_s() >= next_pose_s_ && tracking_->newest() != posed_;
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
  Result<LiveMade> made = make(snapshot, source.get_token());
  const bool cancelled = !made && made.fault().code == "compile.cancelled";
  if (!cancelled) tell(snapshot, std::move(made));
  lock.lock();
  in_progress_.reset();
  cancelled_one_ = cancelled;
  stale_ = stale_ || cancelled;
}

/// With tracked things where they will be when the light comes.
Result<LiveMade> LiveThread::make(LiveSnapshot snapshot, const std::stop_token& stop) {
  const double started_s = monotonic_s();
  LiveMade made;
  follows_ = !bodies_of(*snapshot.project).empty();
  if (follows_) {
    if (tracking_ == nullptr) {
      return Fault{"rig.tracker", "project", "things are tracked, but this rig has no tracker",
                   "start the runtime with --tracker, or give them poses"};
    }
    next_pose_s_ = started_s + 1.0 / snapshot.project->sweep.frequency_hz;
    posed_ = tracking_->newest();
    Result<PosedProject> posed = tracking_->pose(*snapshot.project);
    if (!posed) return posed.fault();
    snapshot.project = posed->project;
    made.posed = std::move(*posed);
  }
  Result<std::shared_ptr<LoadedShow>> show = maker_.make(snapshot, stop);
  if (!show) return show.fault();
  made.show = std::move(*show);
  made.compile_s = monotonic_s() - started_s;
  return made;
}

/// What is made is handed on; what is refused again and again while bodies move is said once.
void LiveThread::tell(const LiveSnapshot& snapshot, Result<LiveMade> made) {
  const LiveTold now{snapshot.revision, snapshot.frame, snapshot.received_s, made ? "" : made.fault().code};
  const bool again = told_ == now;
  told_ = now;
  if (made) {
    made->first = !again;
    results_.made(snapshot, std::move(*made));
  } else if (!again) {
    results_.refused(snapshot.revision, made.fault());
  }
}

}  // namespace focalstage
