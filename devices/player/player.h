#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "devices/player/limits.h"
#include "devices/player/prepared_frames.h"
#include "devices/player/sweep_plan.h"

namespace focalstage {

/// A show ready to play, pushed as a file or made in memory of one live revision; what plays is always one whole show.
struct LoadedShow {
  std::string sha256;  ///< empty for a live one
  ShowHeader header;
  SweepPlan plan;
  std::unique_ptr<PreparedFrames> frames;
  std::uint64_t revision = 0;  ///< of the live link; 0: pushed

  /// Called once, after the first sweep whose light all came, with its number and start. From the thread that keeps the
  /// rig's time: it must not wait.
  std::function<void(std::uint64_t sweep, double start_s)> on_light = {};
};

enum class PlayState { empty, ready, playing, holding, dark };
const char* name_of(PlayState state);

enum class AtEnd { loop, hold };

struct PlayerSettings {
  AtEnd at_end = AtEnd::loop;
  int settle_sweeps = 2;         ///< without light, wherever lens or shutters begin to move otherwise
  bool wait_for_frames = false;  ///< virtual time: a frame is never late
  bool retimes_at_once = true;   ///< triggers may come at other times from one sweep to the next
};

/// What one sweep was asked to show.
struct AskedSweep {
  std::shared_ptr<const LoadedShow> show;
  double start_s = 0.0;
  std::uint64_t number = 0;  ///< of all sweeps handed over
  int frame = 0;
  bool lit = false;               ///< false: nothing was asked (lenses settling) or nothing could be shown
  bool missed = false;            ///< light was due, but its frame was not there in time
  std::vector<Picture> pictures;  ///< one per slot, where lit
};

/// Turns a show into what the rig is given, sweep by sweep. Has no clock and no thread: whoever calls `hand_over` says
/// when the sweep begins. Commands take effect with the next sweep handed over.
class Player {
 public:
  Player(LimitedRig& rig, const PlayerSettings& settings) : rig_(rig), settings_(settings) {}

  /// Takes the place of the show that plays, as one step, as soon as its first frame is there.
  void activate(std::shared_ptr<const LoadedShow> show);

  Status play(std::uint64_t sweeps = 0);  ///< then holds; 0: goes on
  Status hold();
  Status cue(const std::string& name);  ///< jumps as soon as the cue's frame is there
  Status next();                        ///< to the cue after the frame that is on (or is cued)
  Status back();                        ///< to the cue before the one that this frame follows
  Status go();

  /// Light off now; latched until `go`. Whatever was handed over for later is lost.
  void blackout(double now_s, const std::optional<Fault>& fault = std::nullopt);

  /// Puts another show, or none, in the place of what is there, while nothing plays.
  void put(std::shared_ptr<const LoadedShow> show);

  /// Sweeps are to be handed over: playing or holding.
  bool running() const { return state_ == PlayState::playing || state_ == PlayState::holding; }

  /// Gives the rig one sweep. Goes dark by itself where a limit is met or a frame can't be read.
  AskedSweep hand_over(double start_s);

  PlayState state() const { return state_; }
  const std::optional<Fault>& fault() const { return fault_; }
  std::shared_ptr<const LoadedShow> show() const { return show_; }
  std::shared_ptr<const LoadedShow> next_show() const { return next_show_; }
  double period_s() const { return show_ ? show_->plan.period_s : 0.0; }
  int frame() const { return frame_; }
  std::uint64_t sweeps() const { return sweeps_; }

 private:
  void change_show();
  std::vector<int> cue_frames() const;
  void jump_to(int frame);
  void follow_cue();
  void begin(std::shared_ptr<const LoadedShow> show);
  void advance();
  bool fetch(AskedSweep& sweep);
  void drive(const SweepPlan& plan, const AskedSweep& sweep);

  LimitedRig& rig_;
  PlayerSettings settings_;
  PlayState state_ = PlayState::empty;
  std::optional<Fault> fault_;
  std::shared_ptr<const LoadedShow> show_;
  std::shared_ptr<const LoadedShow> next_show_;
  int frame_ = 0;
  int sweep_of_frame_ = 0;
  std::optional<int> cued_frame_;
  int to_settle_ = 0;
  bool drive_is_new_ = true;
  std::uint64_t sweeps_ = 0;
  std::uint64_t sweeps_left_ = 0;  ///< 0: no end
};

}  // namespace focalstage
