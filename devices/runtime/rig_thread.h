#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "core/schedule/projector_models.h"
#include "devices/player/player.h"
#include "devices/player/priority_mutex.h"
#include "devices/runtime/fault_tally.h"
#include "devices/runtime/lateness.h"
#include "devices/runtime/rig_setup.h"
#include "devices/runtime/slot_ledger.h"
#include "io/protocol/rig_values.h"

namespace focalstage {

enum class RigClock { real_time, virtual_time };

struct RigThreadSettings {
  RigSetup rig = simulated_rig();
  RigLimits limits;
  RigClock clock = RigClock::real_time;
  AtEnd at_end = AtEnd::loop;
  ProjectorModels models{};  ///< by which a show's exposures are judged; none: only by the rig itself
  int sweeps_ahead = 6;      ///< handed over before they begin, so that a pause of this program is not seen
};

/// Plays shows on a rig, sweep after sweep, in a thread of its own. In real time sweeps are handed over a
/// few ahead; in virtual time the clock runs as fast as it can while a show plays and stands still otherwise.
///
/// Every call may come from any thread. Blackout does not wait for the sweep to end.
class RigThread {
 public:
  explicit RigThread(const RigThreadSettings& settings);
  ~RigThread();  ///< dark first

  /// Returns once the show has taken the place of the one before: "rig.refused" if its first frame can't be had.
  Status activate(std::shared_ptr<const LoadedShow> show);

  /// The same without waiting, for a show whose frames are there: one that comes before it was shown takes its place.
  void present(std::shared_ptr<const LoadedShow> show);

  /// Dark, and this show (or none) in the place of what was presented to measure by.
  void end_measuring(std::shared_ptr<const LoadedShow> before);

  Status play(std::uint64_t sweeps);
  Status hold();
  Status cue(const std::string& name);
  Status next();
  Status back();
  Status go();
  void blackout();

  /// Latched darkness, for what others came to doubt.
  void doubt(const Fault& fault);

  /// The same, where it matters only while something plays.
  void doubt_what_plays(const Fault& fault);

  RigState state() const;
  std::shared_ptr<const LoadedShow> show() const;

  /// When this thread last went round (monotonic clock), also while there is nothing to do. Waits for nothing.
  double last_beat_s() const { return beat_s_; }

  /// How often it went dark, by the fault's code. Waits for nothing.
  const FaultTally& faults() const { return faults_; }

 private:
  /// The lock, for a caller from outside: in virtual time the rig's own thread would hardly ever let go of it.
  std::unique_lock<PriorityMutex> take_turn() const;
  void let_others(std::unique_lock<PriorityMutex>& lock) const;

  void run(const std::stop_token& stop);
  bool has_work() const;
  void hand_over_next();
  bool skip_if_late(double now_s);
  void count_late(std::uint64_t sweeps);
  void plan_next(double period_s);
  void settle_until(double time_s);
  void heed_doubt();
  void make_dark(const Fault& fault);
  double now_s() const;

  RigThreadSettings settings_;
  mutable PriorityMutex mutex_;
  mutable std::atomic<int> waiting_ = 0;
  mutable std::condition_variable_any changed_;
  std::unique_ptr<Rig> rig_;
  LimitedRig limited_;
  Player player_;
  SlotLedger ledger_;
  Lateness lateness_;
  double next_start_s_ = 0.0;
  double anchor_s_ = 0.0;  ///< the sweep from which starts are counted, of so many sweeps so long
  double anchor_period_s_ = 0.0;
  std::uint64_t since_anchor_ = 0;
  bool on_time_ = false;  ///< the timeline runs: the next sweep follows the one before
  std::uint64_t late_sweeps_ = 0;
  std::uint64_t never_handed_over_ = 0;
  FaultTally faults_;
  std::atomic<double> beat_s_ = 0.0;
  std::jthread thread_;
};

}  // namespace focalstage
