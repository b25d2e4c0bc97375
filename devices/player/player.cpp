#include "devices/player/player.h"

#include <algorithm>
#include <utility>

namespace focalstage {

namespace {

Fault nothing_to_play() {
  return {"rig.refused", "show", "no show is active", "push one with --activate, or activate one that is here"};
}

Fault still_dark() { return {"rig.refused", "rig", "the rig is dark and stays so", "say go first"}; }

Fault no_cue(const char* where) {
  return {"rig.refused", "cues", std::string("the show has no cue ") + where + " this one", "name the cue to jump to"};
}

}  // namespace

const char* name_of(PlayState state) {
  switch (state) {
    case PlayState::empty:
      return "empty";
    case PlayState::ready:
      return "ready";
    case PlayState::playing:
      return "playing";
    case PlayState::holding:
      return "holding";
    case PlayState::dark:
      return "dark";
  }
  return "dark";
}

void Player::activate(std::shared_ptr<const LoadedShow> show) {
  (void)show->frames->get(0);  // starts reading; a frame that can't be read comes out when it is shown
  if (running()) {
    next_show_ = std::move(show);
    return;
  }
  begin(std::move(show));
  if (state_ == PlayState::empty) state_ = PlayState::ready;
}

void Player::begin(std::shared_ptr<const LoadedShow> show) {
  const bool goes_on = running() && show_ && show_->plan.moves_as(show->plan) &&
                       (settings_.retimes_at_once || show_->plan.fires_as(show->plan));
  if (!goes_on) to_settle_ = settings_.settle_sweeps;
  drive_is_new_ = true;
  show_ = std::move(show);
  next_show_.reset();
  frame_ = sweep_of_frame_ = 0;
  cued_frame_.reset();
}

void Player::change_show() {
  if (!next_show_) return;
  PreparedFrames& frames = *next_show_->frames;
  const Result<PreparedFrames::Frame> first = settings_.wait_for_frames ? frames.wait_for(0) : frames.get(0);
  if (first && !*first) return;
  begin(next_show_);
}

Status Player::play(std::uint64_t sweeps) {
  if (state_ == PlayState::dark) return still_dark();
  if (state_ == PlayState::empty) return nothing_to_play();
  if (!running()) {
    to_settle_ = settings_.settle_sweeps;
    drive_is_new_ = true;
  }
  state_ = PlayState::playing;
  sweeps_left_ = sweeps;
  return {};
}

Status Player::hold() {
  if (Status lit = play(); !lit) return lit;
  state_ = PlayState::holding;
  return {};
}

Status Player::cue(const std::string& name) {
  if (!show_) return nothing_to_play();
  const auto& cues = show_->header.cues;
  const auto cue = std::ranges::find(cues, name, &ShowCue::name);
  if (cue == cues.end() || cue->frame < 0 || cue->frame >= show_->header.frames) {
    return Fault{"rig.refused", "cue \"" + name + "\"", "the show has no such cue", "choose one of its cues"};
  }
  jump_to(cue->frame);
  return {};
}

Status Player::next() {
  if (!show_) return nothing_to_play();
  const std::vector<int> frames = cue_frames();
  const auto after = std::ranges::upper_bound(frames, cued_frame_.value_or(frame_));
  if (after == frames.end()) return no_cue("after");
  jump_to(*after);
  return {};
}

Status Player::back() {
  if (!show_) return nothing_to_play();
  const std::vector<int> frames = cue_frames();
  const auto after = std::ranges::upper_bound(frames, cued_frame_.value_or(frame_));
  if (after - frames.begin() < 2) return no_cue("before");
  jump_to(*(after - 2));
  return {};
}

/// In order, each once.
std::vector<int> Player::cue_frames() const {
  std::vector<int> frames;
  for (const ShowCue& cue : show_->header.cues) {
    if (cue.frame >= 0 && cue.frame < show_->header.frames) frames.push_back(cue.frame);
  }
  std::ranges::sort(frames);
  const auto repeated = std::ranges::unique(frames);
  frames.erase(repeated.begin(), repeated.end());
  return frames;
}

void Player::jump_to(int frame) {
  cued_frame_ = frame;
  follow_cue();
}

void Player::follow_cue() {
  if (!cued_frame_) return;
  PreparedFrames& frames = *show_->frames;
  const bool there = frames.prepare(*cued_frame_);
  if (!there && !settings_.wait_for_frames && running()) return;
  frame_ = *std::exchange(cued_frame_, std::nullopt);
  sweep_of_frame_ = 0;
}

Status Player::go() {
  if (state_ != PlayState::dark) return {};
  fault_.reset();
  rig_.reset();
  state_ = show_ ? PlayState::ready : PlayState::empty;
  return {};
}

void Player::blackout(double now_s, const std::optional<Fault>& fault) {
  rig_.dark(now_s);
  if (!fault_) fault_ = fault;
  state_ = PlayState::dark;
  if (next_show_) begin(next_show_);
}

void Player::put(std::shared_ptr<const LoadedShow> show) {
  if (running()) return;
  if (show) return begin(std::move(show));
  show_.reset();
  next_show_.reset();
  if (state_ == PlayState::ready) state_ = PlayState::empty;
}

void Player::advance() {
  ++sweeps_;
  if (state_ != PlayState::playing) return;
  if (++sweep_of_frame_ >= show_->plan.sweeps_per_frame) {
    sweep_of_frame_ = 0;
    const bool last = frame_ + 1 >= show_->header.frames;
    if (last && settings_.at_end == AtEnd::hold) {
      state_ = PlayState::holding;
    } else {
      frame_ = last ? 0 : frame_ + 1;
    }
  }
  if (sweeps_left_ > 0 && --sweeps_left_ == 0) state_ = PlayState::holding;
}

bool Player::fetch(AskedSweep& sweep) {
  PreparedFrames& frames = *show_->frames;
  Result<PreparedFrames::Frame> frame = settings_.wait_for_frames ? frames.wait_for(frame_) : frames.get(frame_);
  if (!frame) {
    blackout(sweep.start_s, frame.fault());
    return false;
  }
  if (!*frame) return false;
  for (const int image : show_->plan.image) {
    sweep.pictures.push_back({*frame, (*frame)->image(static_cast<std::size_t>(image))});
  }
  return true;
}

void Player::drive(const SweepPlan& plan, const AskedSweep& sweep) {
  if (std::exchange(drive_is_new_, false)) {
    rig_.set_exposure(plan.exposure_s, plan.form);
    rig_.announce_triggers(plan.trigger_s);
    for (const Side eye : both_sides) rig_.set_drive(eye, plan.drive_a[eye], plan.drive_step_s);
  }
  rig_.post_images(sweep.pictures);
  rig_.sync_edge(sweep.start_s);
  for (const ShutterCommand& command : plan.shutters) {
    rig_.shutter(command.eye, command.level, sweep.start_s + command.time_s);
  }
  if (!sweep.lit) return;
  for (const double trigger_s : plan.trigger_s) rig_.trigger(sweep.start_s + trigger_s);
}

AskedSweep Player::hand_over(double start_s) {
  change_show();
  follow_cue();
  AskedSweep sweep;
  sweep.show = show_;
  sweep.start_s = start_s;
  sweep.number = sweeps_;
  sweep.frame = frame_;
  const bool settled = to_settle_ == 0;
  if (settled) {
    sweep.lit = fetch(sweep);
    sweep.missed = !sweep.lit;
    if (!running()) return sweep;
  }
  drive(show_->plan, sweep);
  if (rig_.fault()) {
    blackout(start_s, rig_.fault());
    sweep.lit = false;
    sweep.missed = settled;
    sweep.pictures.clear();
    return sweep;
  }
  if (settled) {
    advance();
  } else {
    --to_settle_;
    (void)show_->frames->get(frame_);
  }
  return sweep;
}

}  // namespace focalstage
