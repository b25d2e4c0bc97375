#pragma once

#include <atomic>

namespace focalstage {

/// How long poses take to become light, measured. Written by the thread that sees light, read by any; nobody waits.
class PoseDelay {
 public:
  explicit PoseDelay(double lead_s) : lead_s_(lead_s) {}

  /// Light came at `light_s` of a pose that was seen at `seen_s` and taken at `taken_s`.
  void lit(double seen_s, double taken_s, double light_s) {
    lead_s_ = smoothed(lead_s_, light_s - taken_s);
    if (!follows_) return;
    pose_to_light_s_ = pose_to_light_s_ > 0.0 ? smoothed(pose_to_light_s_, light_s - seen_s) : light_s - seen_s;
  }

  /// Whether something that is tracked plays live; else there is nothing to tell, whatever light still comes.
  void follow(bool follows) {
    follows_ = follows;
    if (!follows) pose_to_light_s_ = 0.0;
  }

  /// From taking a pose to the light of what is made of it: as guessed at first, then as measured.
  double lead_s() const { return lead_s_; }

  /// From light on the tracker's sensors to the sweep that shows it; 0: nothing was measured.
  double pose_to_light_s() const { return pose_to_light_s_; }

 private:
  static double smoothed(double before, double now) { return before + (now - before) / 8.0; }

  std::atomic<bool> follows_ = false;
  std::atomic<double> lead_s_;
  std::atomic<double> pose_to_light_s_ = 0.0;
};

}  // namespace focalstage
