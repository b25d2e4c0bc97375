#pragma once

#include <string>
#include <vector>

#include "core/calibrate/calibration_report.h"
#include "core/calibrate/picked_points.h"
#include "core/scene/edit.h"
#include "core/scene/project.h"
#include "editor/cli/calibrate_actions.h"
#include "io/project/project_file.h"

namespace focalstage {

/// The projector that is meant: the one named, else the only one. "calibrate.projector".
Result<Projector> projector_meant(const LoadedProject& loaded, const std::string& name);

/// Median, 95 %, worst, left-out, coverage and uncertainty, for people. With `each`, a row per point first.
std::string report_text(const CalibrationReport& report, bool each);

/// The same for programs.
Value report_value(const CalibrationReport& report);

/// Where every point lies in the projector's picture, with its error 50 times as long: RGB from the top. Green under
/// half a pixel, yellow under one, red above.
std::vector<std::uint8_t> residual_picture(const CalibrationReport& report, int width_px, int height_px);

/// Refuses what is over the limit, unless told not to; writes the picture where one is asked for, and the edits into
/// the project; prints. The end of every calibration.
ExitStatus finish_calibration(const CalibrateOptions& options, const LoadedProject& loaded, const Projector& projector,
                              const ProjectorCalibration& calibration, Value extra);

}  // namespace focalstage
