#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "devices/roles/rig_port.h"

namespace focalstage {

struct SimProjectorSettings {
  double latency_s = 0.00015;         ///< from trigger to light
  double least_frame_s = 1.0 / 2840;  ///< triggers closer than this are lost (DynaFlash at 8 bits)
};

/// What a trigger started.
struct StartedExposure {
  Picture picture;  ///< no codes where nothing was posted: the trigger showed black
  double start_s = 0.0;
  double duration_s = 0.0;
};

/// A projector that shows, on each trigger, the next of the images posted for the sweep. The sync edge begins the next
/// sweep's images, so a lost trigger misplaces the rest of one sweep and no more.
class SimProjector {
 public:
  explicit SimProjector(const SimProjectorSettings& settings) : settings_(settings) {}

  void set_exposure(double exposure_s) { exposure_s_ = exposure_s; }
  void post(std::vector<Picture> pictures) { sets_.push_back(std::move(pictures)); }
  void sync_edge();
  std::optional<StartedExposure> trigger(double time_s);
  void forget_posted();

  /// Loses the trigger that comes after `count` others from now.
  void drop_trigger_after(std::uint64_t count) { drop_at_ = triggers_ + count; }

 private:
  Picture next_picture();

  SimProjectorSettings settings_;
  double exposure_s_ = 0.0;
  std::deque<std::vector<Picture>> sets_;  ///< the first is the sweep being shown
  std::size_t shown_ = 0;                  ///< images of the first set already taken
  bool begun_ = false;                     ///< a sync edge or an early trigger began the first set
  bool early_ = false;                     ///< the first set was begun by a trigger before its sync edge
  std::uint64_t triggers_ = 0;
  std::optional<std::uint64_t> drop_at_;
  double last_trigger_s_ = -1e300;
};

}  // namespace focalstage
