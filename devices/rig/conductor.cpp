#include "devices/rig/conductor.h"

#include <string>
#include <utility>

#include "devices/rig/rig_tables.h"

namespace focalstage {

namespace {

// A board that still counted on the edges of an earlier run would have given them up by then.
constexpr double earlier_edges_s = 0.05;

Fault lost_trigger(std::uint64_t missed) {
  return {"rig.missed-light", "projector",
          missed > 0 ? "it had no picture for " + std::to_string(missed) + " triggers"
                     : "a trigger came to nothing: its count stands where no period ends",
          "look at the line between trigger board and projector, then say go"};
}

}  // namespace

/// Takes up the score of the sweep that is next, once all of the one before it was shown.
Status Conductor::follow_score(double now_s) {
  const std::shared_ptr<const Score>& wanted = sweeps_.front().score;
  if (score_ && *wanted == *score_) return {};
  if (stage_ == Stage::lit) {
    if (!last_of_score_) last_of_score_ = posted_;
    if (devices_.projector->report().periods < *last_of_score_) return {};
    leave_light();
  }
  if (stage_ == Stage::idle) {
    if (Status started = devices_.lens->start(wanted->drive); !started) return started;
    driven_s_ = now_s;
  } else if (wanted->drive != score_->drive) {
    if (auto refilled = devices_.lens->refill(wanted->drive); !refilled) return refilled.fault();
  }
  score_ = wanted;
  stage_ = Stage::driving;
  return {};
}

void Conductor::leave_light() {
  devices_.projector->dark();
  devices_.board->dark();
  last_of_score_.reset();
}

/// Tables travel while everything is dark.
Status Conductor::prepare() {
  triggers_ = table_triggers(*score_);
  const BoardReport board = devices_.board->report();
  if (triggers_.empty() || !board.period_s || board.told_s < driven_s_ + earlier_edges_s) return {};
  const double latency_s = devices_.projector->abilities().latency_s;
  if (Status armed = devices_.projector->arm(exposures_of(*score_, triggers_, latency_s)); !armed) return armed;
  if (Status loaded = devices_.board->load(board_table(*score_, triggers_, settings_.pulse_s)); !loaded) return loaded;
  watch_ = TriggerWatch(triggers_, score_->drive.period_s);
  stage_ = Stage::prepared;
  return {};
}

/// The projector first, with a period in the dark, so that no trigger finds it without pictures.
Status Conductor::begin_light(double now_s) {
  if (Status started = devices_.projector->start(); !started) return started;
  if (Status dark = devices_.projector->post({}); !dark) return dark;
  posted_ = 1;
  if (Status armed = devices_.board->arm(); !armed) return armed;
  stage_ = Stage::lit;
  // The dark period begins at the coming edge; what was to be shown before the one after it is too late.
  const double period_s = score_->drive.period_s;
  return drop_past(sweeps_, now_s + 1.5 * period_s);
}

Status Conductor::feed() {
  const ProjectorReport report = devices_.projector->report();
  if (report.missed > 0) return lost_trigger(report.missed);
  if (!watch_.sample(report.told_s, report.exposures)) return lost_trigger(0);
  const auto most_ahead = static_cast<std::uint64_t>(devices_.projector->abilities().most_periods_ahead);
  while (posted_ < report.periods + most_ahead) {
    auto pictures = period_pictures(triggers_, sweeps_);
    if (!pictures || sweeps_.empty()) return posted_ > report.periods ? Status() : Status(late_pictures());
    if (Status posted = devices_.projector->post(std::move(*pictures)); !posted) return posted;
    ++posted_;
    sweeps_.pop_front();
  }
  return {};
}

Status Conductor::step(double now_s) {
  if (stage_ != Stage::lit) {
    if (Status dropped = drop_past(sweeps_, now_s); !dropped) return dropped;
  }
  if (!sweeps_.empty()) {
    if (Status followed = follow_score(now_s); !followed) return followed;
  }
  if (stage_ == Stage::driving) {
    if (Status prepared = prepare(); !prepared) return prepared;
  }
  if (stage_ == Stage::prepared) {
    if (Status begun = begin_light(now_s); !begun) return begun;
  }
  return stage_ == Stage::lit ? feed() : Status();
}

void Conductor::forget() {
  stage_ = Stage::idle;
  score_.reset();
  sweeps_.clear();
  posted_ = 0;
  last_of_score_.reset();
}

}  // namespace focalstage
