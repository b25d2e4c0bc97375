#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/calibrate/align.h"
#include "core/calibrate/charuco.h"
#include "core/calibrate/scan_rig.h"
#include "core/stripes/decode.h"

namespace focalstage {

/// One capture, decoded; with the board's corners if one was held there.
struct ScannedCapture {
  std::string name;
  DecodedCapture decoded;
  std::vector<BoardCorner> corners;
};

/// A place that the camera sees and whose coordinates are known.
struct WorldMark {
  std::string name;
  glm::dvec2 camera_px{0.0};
  glm::dvec3 world_m{0.0};
};

/// What ties a scan to the room: where the board of one capture stood, or three or more marks that one capture saw, on
/// faces and not on edges.
struct ScanWorld {
  std::size_t capture = 0;
  std::optional<Rigid> world_from_board;  ///< else `marks`
  std::vector<WorldMark> marks;
};

/// How well a capture's places lie on the rays that the calibrated rig foresees, boards or not: points that had no say.
struct CaptureAgreement {
  std::string name;
  double median_off_px = 0.0;  ///< of the projector
};

struct ProjectorScan {
  ProjectorModel camera;     ///< in the world
  ProjectorModel projector;  ///< in the world
  CalibrationReport report;  ///< in the projector's pixels, over the boards' corners
  CalibrationReport camera_report;
  std::vector<CaptureAgreement> agreements;
  std::optional<Alignment> marks;  ///< how the marks agree, where they fix the world
};

/// The projector, its lens and the camera from captures of a board in four places or more. Beside the faults of
/// board_view, solve_scan_rig and align:
///
/// "scan.world"  the capture that ties the scan to the room has no board, or a mark lies where no place is told. Named.
/// "scan.moved"  a capture lies off the rays by more than `limit_px` in the median: camera or projector were moved
///               before it. Named.
Result<ProjectorScan> calibrate_by_scan(const ProjectorModel& known, const std::vector<ScannedCapture>& captures,
                                        const ScanWorld& world, double limit_px = calibration_limit_px);

}  // namespace focalstage
