// The session's loop: what arrives from behind, and what time brings.
#include <algorithm>
#include <cmath>
#include <limits>

#include "editor/session/session_state.h"
#include "io/protocol/adopt.h"

namespace focalstage {
namespace {

constexpr double sync_every_s = 0.5;
constexpr double look_outside_every_s = 1.0;

/// A file that somebody else wrote is never overwritten, nor taken, without asking.
void look_outside(Session::State& state) {
  if (!state.document || state.asked || state.document->untitled() || !state.document->changed_outside()) return;
  state.asked = Asked{{state.document->file().filename().string() + " was changed by another program",
                       "Reloading it is one step of undo. Keeping yours overwrites theirs with the next save.",
                       {"Reload", "Keep mine"}},
                      {}};
  Session::State* at = &state;
  const auto reload = [at] {
    if (Status done = at->document->reload(); !done) {
      at->say(LogLine::Kind::fault, describe(done.fault()));
      at->document->keep_ours();
    }
    at->tidy();
    at->restage();
    at->wish_preview();
  };
  state.asked->answers = {reload, [at] { at->document->keep_ours(); }};
}

void keep_safe(Session::State& state) {
  if (!state.document || state.now_s - state.synced_at_s < sync_every_s) return;
  state.synced_at_s = state.now_s;
  if (Status synced = state.document->sync(); !synced) state.say(LogLine::Kind::fault, describe(synced.fault()));
}

/// Frames of the timeline as time goes by, over and over.
bool play_on(Session::State& state) {
  const Frames& frames = state.project().frames;
  if (!state.view.playing || frames.count <= 1) return false;
  const double passed = (state.now_s - state.frame_since_s) * frames.rate_hz;
  if (passed < 1.0) return false;
  const int steps = static_cast<int>(std::min(passed, 1e6));
  state.view.frame = (state.view.frame + steps) % frames.count;
  state.frame_since_s += steps / frames.rate_hz;
  return true;
}

void take_focus(Session::State& state) {
  const auto answer = state.preview.focus_answer();
  if (!answer || answer->serial <= state.focus_answered) return;
  state.focus_answered = answer->serial;
  state.focus_question.reset();
  state.view.focus_d = std::clamp(answer->focus_d, -1.0, 10.0);
}

/// A rig that comes, goes or fails says so once, wherever the person looks.
void tell_of_rig(Session::State& state) {
  using Phase = RigStatus::Phase;
  const RigStatus rig = state.rig.status();
  RigTold& told = state.rig_told;
  if (rig.phase != told.phase) {
    if (rig.phase == Phase::connected) {
      state.say(LogLine::Kind::good, "Connected to the rig at " + rig.address);
      if (!rig.simulated) {
        remember_rig(rig.address, state.folders);
        state.recent_rigs = recent_rigs(state.folders);
      }
    }
    if (rig.phase == Phase::lost) {
      state.say(LogLine::Kind::warning, "Lost the rig at " + rig.address + "; it is tried again until it answers");
    }
    told.phase = rig.phase;
  }
  const std::string fault = rig.fault ? describe(*rig.fault) : "";
  if (fault != told.fault && !fault.empty() && rig.phase != Phase::lost) state.say(LogLine::Kind::fault, fault);
  told.fault = fault;
  if (rig.state.fault != told.latched && !rig.state.fault.empty()) {
    state.say(LogLine::Kind::fault, "The rig went dark: " + rig.state.fault);
  }
  told.latched = rig.state.fault;
  if (rig.pushed_sha256 != told.pushed && !rig.pushed_sha256.empty()) {
    state.say(LogLine::Kind::good, "Pushed " + state.project().name + " to the rig");
  }
  told.pushed = rig.pushed_sha256;
}

/// Files that were changed on disk are read again, as if the project had just begun to refer to them.
void look_at_assets(Session::State& state) {
  if (state.document) state.read_files(state.document->shelf().wanted(state.project()));
}

/// What the link could not do is told once; a project made for another rig is a finding as long as it is.
void look_at_rig(Session::State& state) {
  const RigStatus rig = state.rig.status();
  const std::string fault = rig.fault ? describe(*rig.fault) : std::string();
  if (fault != state.rig_fault_said) {
    state.rig_fault_said = fault;
    if (!fault.empty()) state.say(LogLine::Kind::fault, fault);
  }
  const bool there = state.document && rig.phase == RigStatus::Phase::connected && !rig.description.projectors.empty();
  if (!there) {
    state.rig_findings.clear();
    state.rig_checked_revision = 0;
    return;
  }
  if (state.rig_checked_revision == state.revision() && state.rig_checked == rig.description) return;
  state.rig_checked_revision = state.revision();
  state.rig_checked = rig.description;
  state.rig_findings = rig_differences(state.project(), rig_values_of(rig.description));
}

}  // namespace

bool Session::update(double now_s) {
  State& state = *state_;
  state.now_s = now_s;
  bool changed = state.news.exchange(false);
  changed |= state.jobs.finish();
  tell_of_rig(state);
  changed |= play_on(state);
  if (!state.view.playing) state.frame_since_s = now_s;
  if (now_s - state.looked_outside_at_s >= look_outside_every_s) {
    state.looked_outside_at_s = now_s;
    look_outside(state);
    look_at_assets(state);
  }
  keep_safe(state);
  take_focus(state);
  look_at_rig(state);
  state.tidy();
  state.restage();
  state.wish_preview();
  return changed;
}

double Session::next_update_s() const {
  const State& state = *state_;
  if (!state.document) return std::numeric_limits<double>::infinity();
  const double look_s = state.looked_outside_at_s + look_outside_every_s;
  if (!state.view.playing || state.project().frames.count <= 1) return look_s;
  return std::min(look_s, state.frame_since_s + 1.0 / state.project().frames.rate_hz);
}

}  // namespace focalstage
