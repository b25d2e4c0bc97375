#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "editor/cli/command.h"

namespace focalstage {

/// What the actions of `focalstage calibrate viewer` are asked for; each reads what it needs.
struct ViewerOptions {
  std::string project;
  std::string rig;
  std::string eye = "left";
  int questions = 40;
  std::string answers;  ///< file; empty: kept nowhere
  double limit_mm = 1.0;
  bool despite_uncertainty = false;
  double focus_m = 0.0;  ///< of the eye, from the lens
  double focus_uncertainty_d = 0.15;
  double thread_m = 0.0;  ///< from the pupils
  double thread_uncertainty_mm = 1.0;
  std::optional<double> scripted;  ///< what a simulated eye really has; none: a person
  double scripted_noise = 0.0;
  std::uint64_t seed = 1;
  std::string output;
  bool dry_run = false;
  bool json = false;
};

/// What `focalstage calibrate viewer tracker-offset` is asked for.
struct TrackerOffsetOptions {
  std::string sightings;
  std::vector<double> tracker_pose{0, 0, 0, 0, 0, 0, 1};  ///< world from tracker: x y z, quaternion x y z w
  std::vector<double> body_rotation{0, 0, 0, 1};          ///< body from viewer, as far as it is known
  double limit_mm = 2.0;
  bool despite_residual = false;
  bool json = false;
};

ExitStatus run_calibrate_lens_to_pupil(const ViewerOptions& options);
ExitStatus run_calibrate_lens_power(const ViewerOptions& options);
ExitStatus run_calibrate_interpupillary(const ViewerOptions& options);
ExitStatus run_calibrate_tracker_offset(const TrackerOffsetOptions& options);

}  // namespace focalstage
