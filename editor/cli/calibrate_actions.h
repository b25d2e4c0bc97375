#pragma once

#include <string>

#include "core/calibrate/calibration_report.h"
#include "editor/cli/command.h"

namespace focalstage {

/// What the actions of `focalstage calibrate` are asked for; each reads what it needs.
struct CalibrateOptions {
  std::string input;  ///< a file of points, or a folder of captures
  std::string project;
  std::string projector;  ///< empty: as the input says, or the only one
  std::string output;
  std::string picture;  ///< of what parts of the projector's picture were measured
  std::string mesh;     ///< of the scanned surface
  int stripe_px = 4;
  int period_px = 16;
  int steps = 8;
  std::string solve = "pose";
  double limit_px = calibration_limit_px;
  bool despite_residual = false;
  bool dry_run = false;
  bool json = false;
};

ExitStatus run_calibrate_points(const CalibrateOptions& options);
ExitStatus run_calibrate_patterns(const CalibrateOptions& options);
ExitStatus run_calibrate_scan(const CalibrateOptions& options);
ExitStatus run_calibrate_verify(const CalibrateOptions& options);

}  // namespace focalstage
