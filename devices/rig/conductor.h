#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "devices/rig/period_pictures.h"
#include "devices/rig/score.h"
#include "devices/rig/trigger_watch.h"
#include "devices/roles/lens_drive.h"
#include "devices/roles/projector.h"
#include "devices/roles/trigger_board.h"

namespace focalstage {

struct RigDevices {
  std::shared_ptr<ProjectorDevice> projector;
  std::shared_ptr<LensDrive> lens;
  std::shared_ptr<TriggerBoard> board;
};

struct DeviceRigSettings {
  int settle_sweeps = 60;   ///< for lenses to swing in, the board to find the beat, tables to travel
  double pulse_s = 100e-6;  ///< of a projector trigger
};

/// A little of the way from where a sync edge is planned to where the lens drive's beat has it.
double edge_near_s(const LensDrive& lens, double planned_s);

/// Leads the devices through what was handed over: current first, then tables, then triggers, then pictures in time.
/// Has no thread and no clock: `step` is told the time, every millisecond or so. Once light may come, no step waits for
/// a device.
class Conductor {
 public:
  Conductor(const RigDevices& devices, const DeviceRigSettings& settings) : devices_(devices), settings_(settings) {}

  void hand_over(HandedSweep sweep) { sweeps_.push_back(std::move(sweep)); }

  /// A fault is a doubt: whoever leads makes everything dark, and calls `forget`.
  Status step(double now_s);

  /// Everything is dark now, and begins anew with the next sweep handed over.
  void forget();

  /// Devices give something out: from now on a device that fails is a doubt.
  bool leads() const { return stage_ != Stage::idle; }

 private:
  enum class Stage { idle, driving, prepared, lit };

  Status follow_score();
  void leave_light();
  Status drop_past(double before_s);
  Status prepare();
  Status begin_light(double now_s);
  Status feed();

  RigDevices devices_;
  DeviceRigSettings settings_;
  Stage stage_ = Stage::idle;
  std::shared_ptr<const Score> score_;  ///< that the devices play
  std::vector<TableTrigger> triggers_;
  TriggerWatch watch_;
  std::deque<HandedSweep> sweeps_;              ///< not yet posted
  std::uint64_t posted_ = 0;                    ///< periods, since the projector started
  std::optional<std::uint64_t> last_of_score_;  ///< where the sweeps to come have another: periods posted until then
};

}  // namespace focalstage
