#pragma once

#include <string>
#include <vector>

#include "core/base/rigid.h"
#include "core/calibrate/board_view.h"
#include "core/calibrate/calibration_report.h"
#include "core/optics/projector_model.h"

namespace focalstage {

/// A camera and a projector that stand still, and boards that were held before both. The frame is that of the first
/// board. A camera is told as a projector is: what looks and what lights follow the same lens.
struct ScanRig {
  ProjectorModel camera;
  ProjectorModel projector;
  std::vector<Rigid> frame_from_board;  ///< the first is where it is
  CalibrationReport report;             ///< in the projector's pixels; of left-out boards, those of the others alone
  CalibrationReport camera_report;      ///< in the camera's
};

/// Lens and pose of both, by bundle adjustment over all corners in both pictures (focal lengths, centre, k1 k2 p1 p2,
/// of the camera k3 too). Where it starts: Zhang's method for the camera, then the projector as picked points tell it.
/// `known` gives the projector's picture and a first idea of its lens. Refuses
///
/// "scan.few"       fewer than four boards
/// "scan.alike"     boards that stand nearly parallel: they do not tell the focal length from the distance
/// "scan.unsolved"  no rig agrees: another board than the one described, or captures of two rigs
/// "scan.view-off"  one capture disagrees with the others beyond chance: something was moved before it. Named.
Result<ScanRig> solve_scan_rig(const ProjectorModel& known, int camera_width_px, int camera_height_px,
                               const std::vector<BoardView>& views);

}  // namespace focalstage
