#pragma once

#include <string>
#include <vector>

#include "devices/roles/rig_port.h"

namespace focalstage {

/// Remembers what it was given, sweep by sweep.
class RecordingRig : public RigPort {
 public:
  struct Sweep {
    double start_s = 0.0;
    bool new_drive = false;
    std::vector<int> codes;  ///< the first byte of each image posted
    std::vector<double> trigger_s;
    int shutter_commands = 0;
  };

  void set_exposure(double exposure_s, PictureForm form) override {
    exposure_s_ = exposure_s;
    form_ = form;
  }
  void announce_triggers(std::span<const double> trigger_s) override {
    announced_s.assign(trigger_s.begin(), trigger_s.end());
  }
  void set_drive(Side, std::span<const double>, double) override { next_.new_drive = true; }
  void post_images(std::vector<Picture> pictures) override {
    for (const Picture& picture : pictures) next_.codes.push_back(picture.codes[0]);
  }
  void sync_edge(double time_s) override {
    next_.start_s = time_s;
    sweeps.push_back(next_);
    next_ = {};
  }
  void trigger(double time_s) override { sweeps.back().trigger_s.push_back(time_s - sweeps.back().start_s); }
  void shutter(Side, ShutterLevel, double) override { ++sweeps.back().shutter_commands; }
  void dark(double time_s) override { dark_s.push_back(time_s); }

  std::vector<Sweep> sweeps;
  std::vector<double> dark_s;
  std::vector<double> announced_s;
  double exposure_s_ = 0.0;
  PictureForm form_;

 private:
  Sweep next_;
};

}  // namespace focalstage
