#include "devices/plugin/projector_books.h"

#include <algorithm>
#include <string>

namespace focalstage {

namespace {

// Two threads of one machine may read the clock in another order than they tell what they read.
constexpr std::int64_t clock_slack_ns = 1'000'000;

Fault counts_fault(const std::string& what) {
  return {"plugin.counts", "projector", what, "this plugin is broken: do not use it"};
}

}  // namespace

void ProjectorBooks::set_abilities(const focalstage_projector_abilities& abilities) {
  const std::lock_guard lock(mutex_);
  abilities_ = abilities;
}

ProjectorAbilities ProjectorBooks::abilities() const {
  const std::lock_guard lock(mutex_);
  ProjectorAbilities out;
  out.width_px = static_cast<int>(abilities_.width_px);
  out.height_px = static_cast<int>(abilities_.height_px);
  out.pacing = abilities_.pacing == FOCALSTAGE_MASTER ? Pacing::master : Pacing::triggered;
  out.latency_s = 1e-9 * static_cast<double>(abilities_.latency_ns);
  out.most_periods_ahead = static_cast<int>(abilities_.most_periods_ahead);
  return out;
}

void ProjectorBooks::set_exposures(const Exposures& exposures) {
  const std::lock_guard lock(mutex_);
  exposures_ = exposures;
}

Exposures ProjectorBooks::exposures() const {
  const std::lock_guard lock(mutex_);
  return exposures_;
}

void ProjectorBooks::begin(double now_s) {
  const std::lock_guard lock(mutex_);
  running_ = true;
  ++run_;
  posted_ = 0;
  submitted_ = 0;
  counts_ = {};
  counts_.told_ns = static_cast<std::int64_t>(now_s * 1e9);
}

void ProjectorBooks::end() {
  const std::lock_guard lock(mutex_);
  running_ = false;
}

std::uint64_t ProjectorBooks::run() const {
  const std::lock_guard lock(mutex_);
  return running_ ? run_ : 0;
}

Result<std::uint64_t> ProjectorBooks::post() {
  const std::lock_guard lock(mutex_);
  if (!running_) return Fault{"projector.dark", "projector", "it was not started", "start it first"};
  // What was missed gave no room back: a picture waits until its place in a period comes round.
  const std::uint64_t gone = counts_.shown / std::max<std::size_t>(1, exposures_.start_s.size());
  if (posted_ >= gone + abilities_.most_periods_ahead) {
    return Fault{"projector.full", "projector",
                 std::to_string(abilities_.most_periods_ahead) + " periods wait to be shown",
                 "post after the next one"};
  }
  return posted_++;
}

void ProjectorBooks::submitting(std::uint64_t run) {
  const std::lock_guard lock(mutex_);
  if (running_ && run == run_) ++submitted_;
}

void ProjectorBooks::refused(std::uint64_t run) {
  const std::lock_guard lock(mutex_);
  if (running_ && run == run_) --submitted_;
}

std::optional<Fault> ProjectorBooks::told(std::uint64_t run, const focalstage_projector_counts& counts,
                                          std::int64_t now_ns) {
  const std::lock_guard lock(mutex_);
  if (counts.told_ns > now_ns + clock_slack_ns) return counts_fault("its counts are of a moment that is still to come");
  if (!running_ || run != run_) return std::nullopt;
  const bool news = counts_.shown + counts_.missed > 0;
  if (!news && counts.told_ns < counts_.told_ns) return std::nullopt;  // told before this run began
  if (counts.shown > submitted_) {
    return counts_fault("it says that it showed " + std::to_string(counts.shown) + " pictures, and was given " +
                        std::to_string(submitted_));
  }
  const bool back = counts.shown < counts_.shown || counts.missed < counts_.missed || counts.told_ns < counts_.told_ns;
  if (back) return counts_fault("its counts went back");
  counts_ = counts;
  return std::nullopt;
}

ProjectorReport ProjectorBooks::report() const {
  const std::lock_guard lock(mutex_);
  ProjectorReport report;
  report.told_s = 1e-9 * static_cast<double>(counts_.told_ns);
  report.exposures = counts_.shown + counts_.missed;
  report.missed = counts_.missed;
  report.periods = exposures_.start_s.empty() ? 0 : report.exposures / exposures_.start_s.size();
  if (counts_.newest_period_ns != 0) report.newest_period_s = 1e-9 * static_cast<double>(counts_.newest_period_ns);
  return report;
}

}  // namespace focalstage
