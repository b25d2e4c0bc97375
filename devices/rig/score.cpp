#include "devices/rig/score.h"

#include <cmath>
#include <utility>

namespace focalstage {

namespace {

// Times are differences of large ones: less than this is rounding and no change.
constexpr double same_s = 1e-7;

void follow(double& time_s, double told_s) {
  if (std::abs(time_s - told_s) > same_s) time_s = told_s;
}

}  // namespace

void SweepGatherer::set_exposure(double exposure_s, PictureForm form) {
  score_.exposure_s = exposure_s;
  score_.form = form;
}

void SweepGatherer::announce_triggers(std::span<const double> trigger_s) {
  score_.trigger_s.assign(trigger_s.begin(), trigger_s.end());
}

void SweepGatherer::set_drive(Side eye, std::span<const double> drive_a, double step_s) {
  score_.drive.drive_a[eye].assign(drive_a.begin(), drive_a.end());
  score_.drive.period_s = static_cast<double>(drive_a.size()) * step_s;
}

void SweepGatherer::sync_edge(double time_s) {
  sweep_ = HandedSweep{time_s, nullptr, std::exchange(pictures_, {})};
  moved_ = {};
  triggers_ = 0;
}

void SweepGatherer::shutter(Side eye, ShutterLevel level, double time_s) {
  if (!sweep_) return;
  std::optional<ShutterWindow>& window = score_.shutter[eye];
  if (!window) window.emplace();
  follow(level == ShutterLevel::open ? window->open_s : window->close_s, time_s - sweep_->start_s);
  moved_[eye] = true;
}

std::optional<HandedSweep> SweepGatherer::take() {
  if (!sweep_) return std::nullopt;
  for (const Side eye : both_sides) {
    if (!moved_[eye]) score_.shutter[eye].reset();
  }
  if (!kept_ || *kept_ != score_) kept_ = std::make_shared<const Score>(score_);
  HandedSweep sweep = *std::exchange(sweep_, std::nullopt);
  sweep.score = kept_;
  if (triggers_ == 0) sweep.pictures.clear();
  return sweep;
}

void SweepGatherer::forget() {
  sweep_.reset();
  pictures_.clear();
  kept_.reset();
}

}  // namespace focalstage
