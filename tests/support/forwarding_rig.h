#pragma once

#include <memory>
#include <utility>

#include "devices/roles/rig.h"

namespace focalstage::support {

/// A rig that hands everything on to another: what derives from it changes what it must.
class ForwardingRig : public Rig {
 public:
  explicit ForwardingRig(std::unique_ptr<Rig> inner) : inner_(std::move(inner)) {}

  void set_exposure(double exposure_s, PictureForm form) override { inner_->set_exposure(exposure_s, form); }
  void announce_triggers(std::span<const double> trigger_s) override { inner_->announce_triggers(trigger_s); }
  void set_drive(Side eye, std::span<const double> drive_a, double step_s) override {
    inner_->set_drive(eye, drive_a, step_s);
  }
  void post_images(std::vector<Picture> pictures) override { inner_->post_images(std::move(pictures)); }
  void sync_edge(double time_s) override { inner_->sync_edge(time_s); }
  void trigger(double time_s) override { inner_->trigger(time_s); }
  void shutter(Side eye, ShutterLevel level, double time_s) override { inner_->shutter(eye, level, time_s); }
  void dark(double time_s) override { inner_->dark(time_s); }
  int settle_sweeps() const override { return inner_->settle_sweeps(); }
  bool retimes_at_once() const override { return inner_->retimes_at_once(); }
  Status ready() override { return inner_->ready(); }
  double edge_near_s(double planned_s) const override { return inner_->edge_near_s(planned_s); }
  void run_until(double time_s) override { inner_->run_until(time_s); }
  bool sees_light() const override { return inner_->sees_light(); }
  std::vector<DeliveredExposure> take_delivered() override { return inner_->take_delivered(); }
  std::optional<Fault> doubt() const override { return inner_->doubt(); }
  std::vector<RigPart> parts() const override { return inner_->parts(); }

 private:
  std::unique_ptr<Rig> inner_;
};

}  // namespace focalstage::support
