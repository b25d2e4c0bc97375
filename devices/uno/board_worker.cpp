#include <algorithm>
#include <utility>

#include "devices/roles/clock.h"
#include "devices/uno/board.h"
#include "devices/uno/faults.h"

namespace focalstage::uno {

namespace {

constexpr double beat_s = 0.1;
constexpr double lens_beat_s = 0.03;  // where a lens drive's edges come: a rig steers by them
constexpr double silence_s = 0.5;
constexpr double dark_again_s = 0.01;
constexpr double never_s = 1e300;
constexpr double edge_wait_s = 0.004;
constexpr unsigned told = 1;     // the reason of a darkness
constexpr unsigned not_now = 7;  // the board's error

double silent_at_s(const Dialogue& dialogue) { return dialogue.heard_s() + silence_s; }

}  // namespace

void UnoBoard::run(Dialogue& dialogue) {
  // On a crowded machine half a second may pass before a thread of no rank gets its turn, and the board then goes dark.
  prefer_this_thread();
  next_beat_s_ = 0.0;
  next_lens_s_ = 0.0;
  newest_lens_edge_ = 0;
  focalstage::Status going;
  while (going) {
    {
      const std::lock_guard lock(mutex_);
      if (stopping_) break;
    }
    going = turn(dialogue);
    if (going && monotonic_s() > silent_at_s(dialogue)) {
      going = Fault{"uno.silent", dialogue.path(), "the trigger board has not answered for 500 ms",
                    "see its cable and power, then open it again"};
    }
  }
  if (going) (void)dialogue.insist("SAFE", monotonic_s() + 0.05, dark_again_s);
  const std::lock_guard lock(mutex_);
  at_work_ = false;
  report_.armed = false;
  if (!going) {
    phase_ = DevicePhase::lost;
    fault_ = going.fault();
  }
  if (job_ != nullptr) {
    job_->outcome = going ? Fault{"uno.closed", dialogue.path(), "it was closed meanwhile", "open it"} : going.fault();
    job_ = nullptr;
  }
  changed_.notify_all();
}

/// One thing: what makes dark first, then what is asked, then the heartbeat. Fails when the board is lost.
focalstage::Status UnoBoard::turn(Dialogue& dialogue) {
  (void)waker_.answer();  // before it is seen what it rang for
  std::uint64_t dark = 0;
  Job* job = nullptr;
  {
    const std::lock_guard lock(mutex_);
    heard_s_ = dialogue.heard_s();
    report_.bad_lines = board_bad_lines_ + dialogue.damaged();
    if (dark_asked_ != dark_told_) dark = dark_asked_;
    job = job_;
  }
  if (const focalstage::Status fine = take_unasked(dialogue); !fine) return fine;
  if (dark != 0) return make_dark(dialogue, dark);
  if (job != nullptr) return do_job(dialogue, *job);
  if (monotonic_s() >= next_beat_s_) return beat(dialogue);
  if (monotonic_s() >= next_lens_s_) return ask_for_lens_edge(dialogue);
  return dialogue.listen(std::min(next_beat_s_, next_lens_s_));
}

focalstage::Status UnoBoard::make_dark(Dialogue& dialogue, std::uint64_t asked) {
  const Result<Reply> reply = dialogue.insist("SAFE", silent_at_s(dialogue), dark_again_s);
  if (!reply) return reply.fault();
  const std::lock_guard lock(mutex_);
  dark_told_ = asked;
  report_.armed = false;
  phase_ = DevicePhase::ready;
  fault_.reset();  // told to be dark, it has no more to say of why it went dark by itself
  changed_.notify_all();
  return {};
}

bool UnoBoard::comes_first() const {
  const std::lock_guard lock(mutex_);
  return stopping_ || dark_asked_ != dark_told_;
}

/// "uno.woken" if something comes first; else the answer, or what makes the board lost.
Result<Reply> UnoBoard::answer_to(Dialogue& dialogue, const std::string& command, double deadline_s) {
  for (;;) {
    Result<Reply> reply = dialogue.ask(command, std::min(deadline_s, silent_at_s(dialogue)));
    const bool rang = !reply && reply.fault().code == "uno.woken";
    if (!rang || comes_first()) return reply;
  }
}

/// As `answer_to`; a table that comes between arming and its edge is one for after that edge.
Result<Reply> UnoBoard::answer_in_time(Dialogue& dialogue, const std::string& command, double deadline_s) {
  for (;;) {
    Result<Reply> reply = answer_to(dialogue, command, deadline_s);
    const bool too_soon = reply && reply->kind == ReplyKind::error && reply->code == not_now;
    if (!too_soon || !command.starts_with("TABLE") || monotonic_s() > deadline_s) return reply;
    if (const focalstage::Status fine = dialogue.listen(monotonic_s() + edge_wait_s); !fine) return fine.fault();
  }
}

focalstage::Status UnoBoard::say_all(Dialogue& dialogue, const Job& job) {
  for (const std::string& command : job.commands) {
    const Result<Reply> reply = answer_in_time(dialogue, command, job.deadline_s);
    if (!reply && reply.fault().code == "uno.woken") {
      return Fault{"uno.dark", dialogue.path(), "it was made dark meanwhile", "ask again"};
    }
    if (!reply && reply.fault().code == "uno.silent" && monotonic_s() < silent_at_s(dialogue)) {
      return Fault{"uno.slow", dialogue.path(), "the board answers too little to be done in 2 s",
                   "see the USB cable: lines are damaged or lost on it"};
    }
    if (!reply) return reply.fault();
    if (reply->kind == ReplyKind::error) return refusal(dialogue.path(), command, reply->code);
    if (command == "TEST" && reply->words != "0") {
      return failed_test(dialogue.path(), reply->words);
    }
  }
  return {};
}

focalstage::Status UnoBoard::do_job(Dialogue& dialogue, Job& job) {
  bool loaded = false;
  {
    const std::lock_guard lock(mutex_);
    loaded = loaded_;
  }
  focalstage::Status outcome;
  if (job.purpose == Purpose::arm && !loaded) {
    // It may have one of an earlier host.
    outcome = refusal(dialogue.path(), "ARM", 6);
  } else {
    outcome = say_all(dialogue, job);
  }
  if (outcome) outcome = done(dialogue, job);
  const bool lost = !outcome && (outcome.fault().code == "uno.silent" || outcome.fault().code == "serial.gone" ||
                                 outcome.fault().code == "uno.reset");
  const std::lock_guard lock(mutex_);
  job.outcome = outcome;
  job_ = nullptr;
  changed_.notify_all();
  return lost ? outcome : focalstage::Status{};
}

focalstage::Status UnoBoard::done(Dialogue& dialogue, const Job& job) {
  if (job.purpose == Purpose::identify) return {};
  {
    const std::lock_guard lock(mutex_);
    if (job.purpose == Purpose::load) {
      loaded_ = true;
      return {};
    }
    report_.armed = true;
    phase_ = DevicePhase::running;
    fault_.reset();
  }
  // Where it went dark while this was said again for want of an answer, nobody knows which came last.
  if (const focalstage::Status fine = take_unasked(dialogue); !fine) return fine;
  const std::lock_guard lock(mutex_);
  if (report_.armed) return {};
  ++dark_asked_;
  return fault_ ? *fault_ : darkness(dialogue.path(), 0);
}

focalstage::Status UnoBoard::beat(Dialogue& dialogue) {
  const double asked_s = monotonic_s();
  const Result<Reply> reply = answer_to(dialogue, "STAT", silent_at_s(dialogue));
  if (!reply) return reply.fault().code == "uno.woken" ? focalstage::Status{} : reply.fault();
  next_beat_s_ = monotonic_s() + beat_s;
  if (const auto status = decode_status(reply->words)) take_status(dialogue, *status, asked_s);
  return {};
}

focalstage::Status UnoBoard::ask_for_lens_edge(Dialogue& dialogue) {
  const double asked_s = monotonic_s();
  const Result<Reply> reply = answer_to(dialogue, "LENS", silent_at_s(dialogue));
  if (!reply) return reply.fault().code == "uno.woken" ? focalstage::Status{} : reply.fault();
  next_lens_s_ = reply->kind == ReplyKind::error ? never_s : asked_s + beat_s;
  const auto lens = decode_lens(reply->words);
  if (!lens || lens->edges == newest_lens_edge_) return {};
  next_lens_s_ = asked_s + lens_beat_s;
  const std::lock_guard lock(mutex_);
  const std::uint64_t before = report_.lens ? report_.lens->edges : 0;
  const unsigned more = (lens->edges - newest_lens_edge_) & 0xFFFFU;
  newest_lens_edge_ = lens->edges;
  report_.lens = LensEdge{before + more, lens->after_s, asked_s};
  return {};
}

focalstage::Status UnoBoard::take_unasked(Dialogue& dialogue) {
  for (const Reply& reply : dialogue.take_unasked()) {
    if (reply.kind == ReplyKind::boot) return restarted(dialogue.path(), reply.code);
    went_dark(reply.code);
  }
  return {};
}

void UnoBoard::take_status(const Dialogue& dialogue, const StatusLine& status, double asked_s) {
  {
    const std::lock_guard lock(mutex_);
    report_.told_s = asked_s;
    report_.period_s.reset();
    if (status.period_s > 0.0) report_.period_s = status.period_s;
    // Both wrap.
    if (newest_) {
      report_.edges += (status.edges - newest_->edges) & 0xFFFFU;
      board_bad_lines_ += (status.bad_lines - newest_->bad_lines) & 0xFFFFU;
    }
    report_.bad_lines = board_bad_lines_ + dialogue.damaged();
    newest_ = status;
  }
  // Its own word for it may have been damaged on the way.
  if (status.state == StatusLine::State::safe) went_dark(status.reason);
}

void UnoBoard::went_dark(unsigned reason) {
  const std::lock_guard lock(mutex_);
  if (!report_.armed) return;
  report_.armed = false;
  phase_ = DevicePhase::ready;
  if (reason != told) fault_ = darkness(id_.address, reason);
}

}  // namespace focalstage::uno
