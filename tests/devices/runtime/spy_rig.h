#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "devices/runtime/rig_setup.h"

namespace focalstage::sample {

/// Light that a rig gave, and where in the picture its middle was, in pixels from the left; none where all is black.
struct SeenLight {
  double start_s = 0.0;
  std::optional<double> middle_px;
};

/// What several threads look at.
class LightLog {
 public:
  void add(const SeenLight& light) {
    const std::lock_guard lock(mutex_);
    seen_.push_back(light);
  }
  std::vector<SeenLight> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(seen_, {});
  }

 private:
  std::mutex mutex_;
  std::vector<SeenLight> seen_;
};

/// The simulated rig, watched by somebody who stands beside it.
class SpyRig final : public Rig {
 public:
  SpyRig(const SimSettings& settings, std::shared_ptr<LightLog> log)
      : inner_(settings), width_px_(static_cast<std::size_t>(settings.width_px)), log_(std::move(log)) {}

  void set_exposure(double exposure_s, PictureForm form) override { inner_.set_exposure(exposure_s, form); }
  void announce_triggers(std::span<const double> trigger_s) override { inner_.announce_triggers(trigger_s); }
  void set_drive(Side eye, std::span<const double> drive_a, double step_s) override {
    inner_.set_drive(eye, drive_a, step_s);
  }
  void post_images(std::vector<Picture> pictures) override { inner_.post_images(std::move(pictures)); }
  void sync_edge(double time_s) override { inner_.sync_edge(time_s); }
  void trigger(double time_s) override { inner_.trigger(time_s); }
  void shutter(Side eye, ShutterLevel level, double time_s) override { inner_.shutter(eye, level, time_s); }
  void dark(double time_s) override { inner_.dark(time_s); }
  int settle_sweeps() const override { return inner_.settle_sweeps(); }
  bool retimes_at_once() const override { return inner_.retimes_at_once(); }
  Status ready() override { return inner_.ready(); }
  double edge_near_s(double planned_s) const override { return inner_.edge_near_s(planned_s); }
  void run_until(double time_s) override { inner_.run_until(time_s); }
  bool sees_light() const override { return inner_.sees_light(); }
  std::optional<Fault> doubt() const override { return inner_.doubt(); }
  std::vector<RigPart> parts() const override { return inner_.parts(); }

  std::vector<DeliveredExposure> take_delivered() override {
    std::vector<DeliveredExposure> delivered = inner_.take_delivered();
    for (const DeliveredExposure& exposure : delivered) log_->add({exposure.start_s, middle_of(exposure.picture)});
    return delivered;
  }

 private:
  std::optional<double> middle_of(const Picture& picture) const {
    double sum = 0.0;
    double weighed = 0.0;
    for (std::size_t i = 0; i < picture.codes.size(); ++i) {
      sum += picture.codes[i];
      weighed += picture.codes[i] * (static_cast<double>(i % width_px_) + 0.5);
    }
    if (sum == 0.0) return std::nullopt;
    return weighed / sum;
  }

  SimRig inner_;
  std::size_t width_px_;
  std::shared_ptr<LightLog> log_;
};

inline RigSetup spied_rig(const SimSettings& settings, const std::shared_ptr<LightLog>& log) {
  RigSetup setup = simulated_rig(settings);
  setup.make = [=] { return std::make_unique<SpyRig>(settings, log); };
  return setup;
}

}  // namespace focalstage::sample
