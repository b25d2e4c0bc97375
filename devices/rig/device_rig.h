#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include "devices/rig/device_hand.h"
#include "devices/rig/leader.h"
#include "devices/rig/score.h"
#include "devices/roles/rig.h"

namespace focalstage {

/// A rig made of a projector, a lens drive and a trigger board, each seen through its role. What is handed over is
/// played by a thread of its own that leads the devices and watches them; in any doubt it makes all of them dark at
/// once and lets nothing pass until `ready` finds them well.
class DeviceRig final : public Rig {
 public:
  DeviceRig(RigDevices devices, const DeviceRigSettings& settings);
  ~DeviceRig() override;

  void set_exposure(double exposure_s, PictureForm form) override { gatherer_.set_exposure(exposure_s, form); }
  void announce_triggers(std::span<const double> trigger_s) override { gatherer_.announce_triggers(trigger_s); }
  void set_drive(Side eye, std::span<const double> drive_a, double step_s) override {
    gatherer_.set_drive(eye, drive_a, step_s);
  }
  void post_images(std::vector<Picture> pictures) override;
  void sync_edge(double time_s) override { gatherer_.sync_edge(time_s); }
  void trigger(double time_s) override { gatherer_.trigger(time_s); }
  void shutter(Side eye, ShutterLevel level, double time_s) override { gatherer_.shutter(eye, level, time_s); }
  void dark(double time_s) override;

  int settle_sweeps() const override { return settle_sweeps_; }
  bool retimes_at_once() const override { return false; }
  Status ready() override;
  double edge_near_s(double planned_s) const override;
  void run_until(double time_s) override;
  bool sees_light() const override { return false; }
  std::vector<DeliveredExposure> take_delivered() override { return {}; }
  std::optional<Fault> doubt() const override;
  std::vector<RigPart> parts() const override;

 private:
  void hand_on();
  void lead(const std::stop_token& stop);
  void darken(const std::optional<Fault>& doubt);
  bool stop_lens();

  DeviceRigSettings settings_;
  RigDevices devices_;
  int settle_sweeps_;
  SweepGatherer gatherer_;  ///< of the one thread that hands over
  DeviceHand projector_;
  DeviceHand board_;
  DeviceHand lens_;  ///< looks at the two before it
  mutable std::mutex mutex_;
  std::deque<HandedSweep> handed_;
  std::uint64_t darkness_ = 0;  ///< how often it was made dark
  std::optional<Fault> doubt_;
  std::jthread leader_;
};

}  // namespace focalstage
