#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "devices/rig/leader.h"
#include "devices/rig/period_pictures.h"
#include "devices/rig/trigger_watch.h"

namespace focalstage {

/// Leads a rig whose projector waits for triggers: current first, then tables, then triggers, then pictures in time.
/// Once light may come, no step waits for a device.
class Conductor final : public Leader {
 public:
  Conductor(const RigDevices& devices, const DeviceRigSettings& settings) : devices_(devices), settings_(settings) {}

  void hand_over(HandedSweep sweep) override { sweeps_.push_back(std::move(sweep)); }
  Status step(double now_s) override;
  void forget() override;
  bool leads() const override { return stage_ != Stage::idle; }

 private:
  enum class Stage { idle, driving, prepared, lit };

  Status follow_score(double now_s);
  void leave_light();
  Status prepare();
  Status begin_light(double now_s);
  Status feed();

  RigDevices devices_;
  DeviceRigSettings settings_;
  Stage stage_ = Stage::idle;
  std::shared_ptr<const Score> score_;  ///< that the devices play
  double driven_s_ = 0.0;               ///< when the lens drive was started
  std::vector<TableTrigger> triggers_;
  TriggerWatch watch_;
  std::deque<HandedSweep> sweeps_;              ///< not yet posted
  std::uint64_t posted_ = 0;                    ///< periods, since the projector started
  std::optional<std::uint64_t> last_of_score_;  ///< where the sweeps to come have another: periods posted until then
};

}  // namespace focalstage
