#pragma once

#include <span>
#include <vector>

#include "core/base/sides.h"
#include "devices/roles/picture.h"

namespace focalstage {

/// The liquid crystal is dark under voltage and clear without.
enum class ShutterLevel { closed, open };

/// All that a rig's hardware is ever given (design section 8). Times are seconds of the rig's own clock. One sweep is
/// handed over as a whole before it begins: its drive where that changed, its images in the order of the triggers, its
/// sync edge, its triggers and its shutter levels.
class RigPort {
 public:
  RigPort() = default;
  RigPort(const RigPort&) = delete;
  RigPort& operator=(const RigPort&) = delete;
  virtual ~RigPort() = default;

  /// How long the projector shows an image after each trigger, and how the images are to be read.
  virtual void set_exposure(double exposure_s, PictureForm form) = 0;

  /// When in a sweep its triggers will come, seconds from the sync edge and in time order, negative before it: for a
  /// rig that loads them beforehand. From the next sync edge on; a sweep then has all of these triggers or none.
  virtual void announce_triggers(std::span<const double> trigger_s) = 0;

  /// Refills the waveform generator of one lens: played from the next sync edge on, over and over.
  virtual void set_drive(Side eye, std::span<const double> drive_a, double step_s) = 0;

  /// The images of the sweep whose sync edge comes next, one per trigger.
  virtual void post_images(std::vector<Picture> pictures) = 0;

  virtual void sync_edge(double time_s) = 0;
  virtual void trigger(double time_s) = 0;
  virtual void shutter(Side eye, ShutterLevel level, double time_s) = 0;

  /// Light off, shutters closed and no current from `time_s` on; whatever was handed over for later is forgotten.
  virtual void dark(double time_s) = 0;
};

}  // namespace focalstage
