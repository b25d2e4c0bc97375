#pragma once

#include <vector>

#include "core/base/result.h"
#include "devices/roles/rig_port.h"
#include "io/show/show.h"

namespace focalstage {

struct ShutterCommand {
  Side eye = Side::left;
  ShutterLevel level = ShutterLevel::closed;
  double time_s = 0.0;  ///< from the period's start

  bool operator==(const ShutterCommand&) const = default;
};

/// What the rig is given in every sweep of a show, apart from the images.
struct SweepPlan {
  double period_s = 0.0;
  double exposure_s = 0.0;
  PictureForm form;
  double drive_step_s = 0.0;
  PerEye<std::vector<double>> drive_a;
  std::vector<double> trigger_s;         ///< from the period's start, in time order
  std::vector<int> image;                ///< which image each trigger shows
  std::vector<ShutterCommand> shutters;  ///< in time order
  int sweeps_per_frame = 1;

  /// The lens and the shutters go on as they are: nothing has to settle between the two.
  bool moves_as(const SweepPlan& other) const;

  /// Exposures come at the same times, last as long, and show pictures of the same form.
  bool fires_as(const SweepPlan& other) const;
};

/// `bits`: of the show's codes. Faults "show.schedule": a schedule that no rig could follow, with the place in the
/// show.
Result<SweepPlan> sweep_plan(const ShowHeader& show, int bits);

}  // namespace focalstage
