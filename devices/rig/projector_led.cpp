#include "devices/rig/projector_led.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/base/periodic.h"
#include "devices/rig/rig_tables.h"

namespace focalstage {

namespace {

// Periods from posting a picture to its light: those that wait, the one that is packed, and the one that the projector
// keeps.
constexpr double periods_to_light = 4.0;
// So long the projector's periods are measured before the drive is told to follow them.
constexpr double measuring_s = 0.5;
// The projector's period may differ so much from the show's; a measurement that says more is none.
constexpr double most_apart = 2.5e-3;
// Without a look at the drive's edge for so long, nothing is known any more.
constexpr double most_unseen_s = 0.8;
// That, and a drive's crystal.
constexpr double most_correction = 3e-3;

Fault out_of_step(const BeatFollower& follower) {
  const std::string by =
      follower.late_s() ? std::to_string(std::abs(1e6 * *follower.late_s())) + " us" : std::string("an unknown time");
  return {"rig.out-of-step", "lens drive", "its edge is off the projector's by " + by + ", or is not seen any more",
          "see the lines to D2 and D8 of the trigger board, then say go"};
}

Fault no_pictures(std::uint64_t missed) {
  return {"rig.missed-light", "projector", "it had no pictures for " + std::to_string(missed) + " exposures",
          "see that nothing else keeps this machine busy, then say go"};
}

}  // namespace

/// Takes up the score of the sweep that is next, once all of the one before it was shown.
Status ProjectorLed::follow_score(double now_s) {
  const std::shared_ptr<const Score>& wanted = sweeps_.front().score;
  if (score_ && *wanted == *score_) return {};
  if (stage_ == Stage::lit) {
    if (next_) return {};
    if (!leave_at_s_) leave_at_s_ = now_s + periods_to_light * period_s_;
    if (now_s < *leave_at_s_) return {};
  }
  const bool drives = stage_ != Stage::idle;
  if (drives) {
    (void)devices_.projector->dark();
    (void)devices_.board->dark();
  }
  if (!drives) {
    if (Status started = devices_.lens->start(wanted->drive); !started) return started;
  } else if (wanted->drive != score_->drive) {
    if (auto refilled = devices_.lens->refill(wanted->drive); !refilled) return refilled.fault();
  }
  leave_at_s_.reset();
  score_ = wanted;
  return begin();
}

/// The projector runs, in black, so that there are edges. A score without exposures has nothing to begin with yet.
Status ProjectorLed::begin() {
  stage_ = Stage::starting;
  first_report_.reset();
  triggers_ = table_triggers(*score_);
  if (triggers_.empty()) return {};
  const Exposures exposures = exposures_of(*score_, triggers_, devices_.projector->abilities().latency_s);
  first_light_s_ = exposures.start_s.front();
  if (Status armed = devices_.projector->arm(exposures); !armed) return armed;
  return devices_.projector->start();
}

/// Once the projector's period is known, and the board hears its edges: tables, and the drive begins to follow.
Status ProjectorLed::prepare(double now_s) {
  if (triggers_.empty() || !devices_.board->report().period_s) return {};
  const ProjectorReport report = devices_.projector->report();
  if (!report.newest_period_s || report.periods == 0) return {};
  if (!first_report_) {
    first_report_ = report;
    started_s_ = now_s;
  }
  if (now_s - started_s_ < measuring_s || report.periods == first_report_->periods) return {};
  const double measured_s = (*report.newest_period_s - *first_report_->newest_period_s) /
                            static_cast<double>(report.periods - first_report_->periods);
  const double show_s = score_->drive.period_s;
  period_s_ = std::abs(measured_s / show_s - 1.0) <= most_apart ? measured_s : show_s;
  if (Status loaded = devices_.board->load(shutter_table(*score_, first_light_s_)); !loaded) return loaded;
  FollowSettings settings;
  settings.period_s = period_s_;
  settings.wanted_s = wrapped_s(-first_light_s_, period_s_);
  settings.most_correction = most_correction;
  follower_ = BeatFollower(settings);
  if (Status steered = devices_.lens->steer(period_s_, 0.0); !steered) return steered;
  stage_ = Stage::following;
  lens_seen_s_ = now_s;
  return {};
}

/// The board's clock is off, but for both its times alike. The projector's period is known best by what the drive, once
/// in step, was steered to.
Status ProjectorLed::follow(double now_s) {
  const BoardReport board = devices_.board->report();
  if (!board.lens || !board.period_s || board.lens->edges == lens_edges_) return {};
  lens_edges_ = board.lens->edges;
  lens_seen_s_ = now_s;
  const DriveReport drive = devices_.lens->report();
  const double after_s = board.lens->after_s * period_s_ / *board.period_s - drive.edge_late_s;
  follower_.want(wrapped_s(-first_light_s_ * period_s_ / drive.period_s, period_s_));
  // By the drive's own periods: what was asked of it comes by those.
  const auto steering = follower_.sees(static_cast<double>(lens_edges_) * period_s_, wrapped_s(after_s, period_s_));
  return steering ? devices_.lens->steer(steering->period_s, steering->later_s) : Status();
}

Status ProjectorLed::begin_light(double now_s) {
  for (int period = 0; period < 2; ++period) {
    if (Status dark = devices_.projector->post({}); !dark) return dark;
  }
  if (Status armed = devices_.board->arm(); !armed) return armed;
  stage_ = Stage::lit;
  fed_from_ = devices_.projector->report().periods + static_cast<std::uint64_t>(periods_to_light);
  return drop_past(sweeps_, now_s + periods_to_light * period_s_);
}

Status ProjectorLed::feed() {
  const ProjectorReport report = devices_.projector->report();
  if (report.periods < fed_from_) missed_ = report.missed;
  if (report.missed > missed_) return no_pictures(report.missed - missed_);
  for (;;) {
    if (!next_ && !sweeps_.empty() && *sweeps_.front().score == *score_) {
      next_ = period_pictures(triggers_, sweeps_);
      if (next_) sweeps_.pop_front();
    }
    // Until the last of a score was shown: in the dark.
    if (!next_ && leave_at_s_) next_.emplace();
    if (!next_) return {};
    const Status posted = devices_.projector->post(*next_);
    if (posted || leave_at_s_) next_.reset();
    if (!posted) return posted.fault().code == "projector.full" ? Status() : posted;
  }
}

Status ProjectorLed::step(double now_s) {
  if (stage_ != Stage::lit) {
    if (Status dropped = drop_past(sweeps_, now_s); !dropped) return dropped;
  }
  if (!sweeps_.empty()) {
    if (Status followed = follow_score(now_s); !followed) return followed;
  }
  if (stage_ == Stage::starting) {
    if (Status prepared = prepare(now_s); !prepared) return prepared;
  }
  if (stage_ != Stage::following && stage_ != Stage::lit) return {};
  if (Status followed = follow(now_s); !followed) return followed;
  const bool in_step = follower_.in_step() && now_s - lens_seen_s_ <= most_unseen_s;
  if (stage_ == Stage::lit && !in_step) return out_of_step(follower_);
  if (stage_ == Stage::following && in_step) {
    if (Status begun = begin_light(now_s); !begun) return begun;
  }
  return stage_ == Stage::lit ? feed() : Status();
}

void ProjectorLed::forget() {
  stage_ = Stage::idle;
  score_.reset();
  sweeps_.clear();
  next_.reset();
  leave_at_s_.reset();
  first_report_.reset();
  missed_ = fed_from_ = 0;
}

}  // namespace focalstage
