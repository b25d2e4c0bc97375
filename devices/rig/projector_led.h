#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "devices/rig/beat_follower.h"
#include "devices/rig/leader.h"
#include "devices/rig/period_pictures.h"

namespace focalstage {

/// Leads a rig whose projector is the clock. The projector's own edges are the board's sync; the board sees the lens
/// drive's against them, and the drive is steered by what it sees. There is light only while the drive is in step:
/// current and black periods first, then tables, then the drive's phase, then shutters and pictures.
class ProjectorLed final : public Leader {
 public:
  ProjectorLed(const RigDevices& devices, const DeviceRigSettings& settings) : devices_(devices), settings_(settings) {}

  void hand_over(HandedSweep sweep) override { sweeps_.push_back(std::move(sweep)); }
  Status step(double now_s) override;
  void forget() override;
  bool leads() const override { return stage_ != Stage::idle; }

 private:
  enum class Stage { idle, starting, following, lit };

  Status follow_score(double now_s);
  Status begin();
  Status prepare(double now_s);
  Status follow(double now_s);
  Status begin_light(double now_s);
  Status feed();

  RigDevices devices_;
  DeviceRigSettings settings_;
  Stage stage_ = Stage::idle;
  std::shared_ptr<const Score> score_;
  std::optional<double> leave_at_s_;  ///< where the sweeps to come have another score: all before them is shown then
  std::vector<TableTrigger> triggers_;
  double first_light_s_ = 0.0;  ///< of a period: the projector's edge
  double started_s_ = 0.0;
  std::optional<ProjectorReport> first_report_;  ///< since it runs
  double period_s_ = 0.0;                        ///< the projector's, by the monotonic clock
  BeatFollower follower_;
  std::uint64_t lens_edges_ = 0;  ///< that were looked at
  double lens_seen_s_ = 0.0;
  std::deque<HandedSweep> sweeps_;
  std::optional<std::vector<Picture>> next_;  ///< of the first of those, which the projector has no room for yet
  std::uint64_t missed_ = 0;                  ///< before it had pictures to show
  std::uint64_t fed_from_ = 0;                ///< periods, from which on it must have them
};

}  // namespace focalstage
