#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/base/sides.h"
#include "devices/roles/lens_drive.h"
#include "devices/roles/picture.h"
#include "devices/roles/rig_port.h"
#include "devices/roles/trigger_board.h"

namespace focalstage {

/// What the devices of a rig do in every sweep, apart from the pictures.
struct Score {
  double exposure_s = 0.0;
  PictureForm form;
  DrivePeriod drive;
  std::vector<double> trigger_s;  ///< from the sync edge, in time order; negative before it
  PerEye<std::optional<ShutterWindow>> shutter;

  bool operator==(const Score&) const = default;
};

/// One sweep as it was handed over.
struct HandedSweep {
  double start_s = 0.0;  ///< on the monotonic clock
  std::shared_ptr<const Score> score;
  std::vector<Picture> pictures;  ///< one per trigger; none: dark
};

/// Gathers the calls of a RigPort into whole sweeps. Pure; the score is the same object as long as nothing in it
/// changes.
class SweepGatherer {
 public:
  void set_exposure(double exposure_s, PictureForm form);
  void announce_triggers(std::span<const double> trigger_s);
  void set_drive(Side eye, std::span<const double> drive_a, double step_s);
  void post_images(std::vector<Picture> pictures) { pictures_ = std::move(pictures); }
  void sync_edge(double time_s);
  void shutter(Side eye, ShutterLevel level, double time_s);
  void trigger(double) { ++triggers_; }

  /// The sweep whose sync edge came last, now that all of it has come.
  std::optional<HandedSweep> take();
  void forget();

 private:
  Score score_;
  std::shared_ptr<const Score> kept_;
  std::vector<Picture> pictures_;
  std::optional<HandedSweep> sweep_;
  PerEye<bool> moved_;  ///< the shutter, in this sweep
  std::size_t triggers_ = 0;
};

}  // namespace focalstage
