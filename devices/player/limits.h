#pragma once

#include <optional>

#include "core/base/result.h"
#include "devices/roles/rig_port.h"

namespace focalstage {

/// What the rig's own configuration allows, whatever a show asks (design section 8).
struct RigLimits {
  double lens_current_max_a = 0.29;        ///< either way
  double shutter_changes_per_s_max = 200;  ///< of one shutter
  double light_share_max = 0.8;            ///< of a sweep in which the lamp may be on
};

/// The last door before the hardware. An output beyond the limits does not pass, and nothing passes after it until
/// `reset`: the fault stays in `fault`, and whoever drives the rig makes it dark.
class LimitedRig : public RigPort {
 public:
  LimitedRig(RigPort& rig, const RigLimits& limits) : rig_(rig), limits_(limits) {}

  void set_exposure(double exposure_s, PictureForm form) override;
  void announce_triggers(std::span<const double> trigger_s) override;
  void set_drive(Side eye, std::span<const double> drive_a, double step_s) override;
  void post_images(std::vector<Picture> pictures) override;
  void sync_edge(double time_s) override;
  void trigger(double time_s) override;
  void shutter(Side eye, ShutterLevel level, double time_s) override;
  void dark(double time_s) override;

  const std::optional<Fault>& fault() const { return fault_; }
  void reset() { fault_.reset(); }

 private:
  void refuse(const char* code, const char* where, std::string message);

  RigPort& rig_;
  RigLimits limits_;
  std::optional<Fault> fault_;
  double exposure_s_ = 0.0;
  double edge_s_ = -1e300;  ///< the last two sync edges
  double earlier_edge_s_ = -1e300;
  int lit_in_sweep_ = 0;  ///< triggers since the last sync edge
  PerEye<ShutterLevel> level_{ShutterLevel::open, ShutterLevel::open};
  PerEye<double> last_change_s_{-1e300, -1e300};
  PerEye<double> earlier_change_s_{-1e300, -1e300};
};

}  // namespace focalstage
