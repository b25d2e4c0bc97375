#include "devices/runtime/rig_thread.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <spdlog/spdlog.h>

#include "devices/roles/clock.h"
#include "devices/runtime/part_report.h"

namespace focalstage {

namespace {

/// How often an idle rig's thread shows that it is alive.
constexpr std::chrono::milliseconds idle_beat{100};

PlayerSettings player_settings(const RigThreadSettings& settings, const Rig& rig) {
  return {settings.at_end, rig.settle_sweeps(), settings.clock == RigClock::virtual_time, rig.retimes_at_once()};
}

Fault missed_light() {
  return {"rig.missed-light", "projector", "a sweep lacked light that was due",
          "see what the slots report, then say go"};
}

Fault late_frame() {
  return {"rig.missed-light", "player", "a sweep was not ready when it began",
          "see that nothing else keeps this machine busy, then say go"};
}

}  // namespace

RigThread::RigThread(const RigThreadSettings& settings)
    : settings_(settings),
      rig_(settings.rig.make()),
      limited_(*rig_, settings.limits),
      player_(limited_, player_settings(settings, *rig_)),
      ledger_(rig_->sees_light()),
      beat_s_(monotonic_s()),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

RigThread::~RigThread() {
  blackout();
  thread_.request_stop();
  changed_.notify_all();
}

std::unique_lock<PriorityMutex> RigThread::take_turn() const {
  ++waiting_;
  std::unique_lock lock(mutex_);
  --waiting_;
  return lock;
}

void RigThread::let_others(std::unique_lock<PriorityMutex>& lock) const {
  if (waiting_ == 0) return;
  lock.unlock();
  while (waiting_ > 0) std::this_thread::yield();
  lock.lock();
}

double RigThread::now_s() const { return settings_.clock == RigClock::real_time ? monotonic_s() : next_start_s_; }

/// In virtual time nothing moves while nothing plays.
bool RigThread::has_work() const {
  if (settings_.clock == RigClock::real_time) return player_.running();
  return player_.state() == PlayState::playing || player_.next_show() != nullptr;
}

void RigThread::run(const std::stop_token& stop) {
  if (settings_.clock == RigClock::real_time) prefer_this_thread();
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    beat_s_ = monotonic_s();
    if (!changed_.wait_for(lock, stop, idle_beat, [&] { return has_work(); })) continue;
    const double period_s = player_.period_s();
    const double ahead_s = settings_.sweeps_ahead * period_s;
    if (!on_time_) {
      if (settings_.clock == RigClock::real_time) next_start_s_ = monotonic_s() + ahead_s;
      on_time_ = true;
    }
    if (settings_.clock == RigClock::real_time) {
      const double planned_s = next_start_s_ - ahead_s;
      lock.unlock();
      sleep_until(planned_s);
      lock.lock();
      if (!player_.running() || !on_time_) continue;
      const double now = monotonic_s();
      lateness_.add(now - planned_s);
      if (skip_if_late(now)) continue;
    }
    hand_over_next();
    settle_until(settings_.clock == RigClock::real_time ? monotonic_s() : next_start_s_ - 2.0 * period_s);
    if (settings_.clock == RigClock::virtual_time && !has_work()) settle_until(next_start_s_);
    changed_.notify_all();
    let_others(lock);
  }
}

/// A sweep that begins before it could be handed over stays dark, is counted, and is the last.
bool RigThread::skip_if_late(double now) {
  if (now < next_start_s_) return false;
  const double lost = std::floor((now - next_start_s_) / player_.period_s()) + 1.0;
  count_late(static_cast<std::uint64_t>(lost));
  make_dark(late_frame());
  return true;
}

void RigThread::count_late(std::uint64_t sweeps) {
  late_sweeps_ += sweeps;
  never_handed_over_ += sweeps * player_.show()->plan.trigger_s.size();
}

void RigThread::hand_over_next() {
  AskedSweep sweep = player_.hand_over(next_start_s_);
  plan_next(sweep.show->plan.period_s);
  if (sweep.missed && player_.running()) {
    count_late(1);
    make_dark(late_frame());
    return;
  }
  ledger_.ask(std::move(sweep));
  if (player_.running()) return;
  on_time_ = false;
  if (player_.fault()) faults_.count(player_.fault()->code);
  spdlog::error("dark: {}", player_.fault() ? describe(*player_.fault()) : std::string());
}

/// Counted from where the plan last had to move, so that a day of sweeps adds no rounding.
void RigThread::plan_next(double period_s) {
  const double expected_s = anchor_s_ + static_cast<double>(since_anchor_) * anchor_period_s_;
  if (next_start_s_ != expected_s || period_s != anchor_period_s_) {
    anchor_s_ = next_start_s_;
    anchor_period_s_ = period_s;
    since_anchor_ = 0;
  }
  ++since_anchor_;
  next_start_s_ = rig_->edge_near_s(anchor_s_ + static_cast<double>(since_anchor_) * period_s);
}

void RigThread::settle_until(double time_s) {
  rig_->run_until(time_s);
  ledger_.deliver(rig_->take_delivered());
  ledger_.settle_until(time_s);
  if (ledger_.take_faulty_sweeps() > 0 && player_.running()) make_dark(missed_light());
  heed_doubt();
}

/// The rig is dark already; what it doubts is said, and latched, here.
void RigThread::heed_doubt() {
  const std::optional<Fault> doubt = rig_->doubt();
  if (doubt && player_.running()) make_dark(*doubt);
}

void RigThread::make_dark(const Fault& fault) {
  const double at_s = now_s();
  player_.blackout(at_s, fault);
  ledger_.call_off_after(at_s);
  on_time_ = false;
  faults_.count(fault.code);
  spdlog::error("dark: {}; {} sweeps late so far", describe(fault), late_sweeps_);
}

Status RigThread::activate(std::shared_ptr<const LoadedShow> show) {
  if (const auto first = show->frames->wait_for(0); !first) return first.fault();
  {
    const auto lock = take_turn();
    player_.activate(show);
    changed_.notify_all();
  }
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (std::chrono::steady_clock::now() < give_up) {
    {
      const auto lock = take_turn();
      if (player_.next_show() != show) return {};
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return Fault{"rig.refused", "show", "it did not take the place of the one that plays", "look at the rig's log"};
}

void RigThread::present(std::shared_ptr<const LoadedShow> show) {
  const auto lock = take_turn();
  player_.activate(std::move(show));
  changed_.notify_all();
}

Status RigThread::play(std::uint64_t sweeps) {
  const auto lock = take_turn();
  if (Status ready = rig_->ready(); !ready) return ready;
  Status done = player_.play(sweeps);
  changed_.notify_all();
  return done;
}

Status RigThread::hold() {
  const auto lock = take_turn();
  if (Status ready = rig_->ready(); !ready) return ready;
  Status done = player_.hold();
  changed_.notify_all();
  return done;
}

Status RigThread::cue(const std::string& name) {
  const auto lock = take_turn();
  return player_.cue(name);
}

Status RigThread::next() {
  const auto lock = take_turn();
  return player_.next();
}

Status RigThread::back() {
  const auto lock = take_turn();
  return player_.back();
}

Status RigThread::go() {
  const auto lock = take_turn();
  if (Status ready = rig_->ready(); !ready) return ready;
  (void)ledger_.take_faulty_sweeps();
  return player_.go();
}

void RigThread::blackout() {
  const auto lock = take_turn();
  const double at_s = now_s();
  player_.blackout(at_s);
  ledger_.call_off_after(at_s);
  on_time_ = false;
  changed_.notify_all();
}

void RigThread::end_measuring(std::shared_ptr<const LoadedShow> before) {
  blackout();
  const auto lock = take_turn();
  player_.put(std::move(before));
  ledger_.forget();
}

void RigThread::doubt(const Fault& fault) {
  const auto lock = take_turn();
  make_dark(fault);
  changed_.notify_all();
}

void RigThread::doubt_what_plays(const Fault& fault) {
  const auto lock = take_turn();
  if (!player_.running()) return;
  make_dark(fault);
  changed_.notify_all();
}

std::shared_ptr<const LoadedShow> RigThread::show() const {
  const auto lock = take_turn();
  return player_.show();
}

RigState RigThread::state() const {
  const auto lock = take_turn();
  RigState state;
  state.state = name_of(player_.state());
  if (player_.show()) state.show_sha256 = player_.show()->sha256;
  state.sweeps = player_.sweeps();
  state.missed_exposures = ledger_.missed() + never_handed_over_;
  if (player_.running()) {
    const double sweeps = (now_s() - next_start_s_) / player_.period_s();
    state.lens_phase = sweeps - std::floor(sweeps);
  }
  for (const RigPart& part : rig_->parts()) {
    state.parts.push_back(report_of(part));
    for (const auto& [name, celsius] : part.state.temperatures) {
      state.temperatures.push_back({name, celsius});
      state.temperature_c = state.temperatures.size() == 1 ? celsius : std::max(state.temperature_c, celsius);
    }
  }
  if (player_.fault()) state.fault = describe(*player_.fault());
  state.slots = ledger_.slots();
  state.frame = player_.frame();
  if (player_.show() && player_.show()->revision > 0) {
    state.revision = player_.show()->revision;
    state.frame = player_.show()->header.first_frame;
  }
  state.late_sweeps = late_sweeps_;
  state.lateness = lateness_.bins();
  return state;
}

}  // namespace focalstage
