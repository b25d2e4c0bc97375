#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include "devices/sim/sim_rig.h"

namespace focalstage {

/// A simulated rig whose time stands still while `stuck` holds: whoever keeps it waits.
class StuckRig final : public Rig {
 public:
  StuckRig(const SimSettings& settings, std::shared_ptr<std::atomic<bool>> stuck) : sim_(settings), stuck_(stuck) {}

  void set_exposure(double exposure_s, PictureForm form) override { sim_.set_exposure(exposure_s, form); }
  void announce_triggers(std::span<const double> trigger_s) override { sim_.announce_triggers(trigger_s); }
  void set_drive(Side eye, std::span<const double> drive_a, double step_s) override {
    sim_.set_drive(eye, drive_a, step_s);
  }
  void post_images(std::vector<Picture> pictures) override { sim_.post_images(std::move(pictures)); }
  void sync_edge(double time_s) override { sim_.sync_edge(time_s); }
  void trigger(double time_s) override { sim_.trigger(time_s); }
  void shutter(Side eye, ShutterLevel level, double time_s) override { sim_.shutter(eye, level, time_s); }
  void dark(double time_s) override { sim_.dark(time_s); }
  int settle_sweeps() const override { return sim_.settle_sweeps(); }
  bool retimes_at_once() const override { return sim_.retimes_at_once(); }
  Status ready() override { return sim_.ready(); }
  double edge_near_s(double planned_s) const override { return planned_s; }
  void run_until(double time_s) override {
    while (*stuck_) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    sim_.run_until(time_s);
  }
  bool sees_light() const override { return sim_.sees_light(); }
  std::vector<DeliveredExposure> take_delivered() override { return sim_.take_delivered(); }
  std::optional<Fault> doubt() const override { return sim_.doubt(); }
  std::vector<RigPart> parts() const override { return sim_.parts(); }

 private:
  SimRig sim_;
  std::shared_ptr<std::atomic<bool>> stuck_;
};

}  // namespace focalstage
