#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/rigid.h"

namespace focalstage {

/// A camera as it was calibrated, in this project's convention: pixel i covers [i, i + 1), so that cx and cy are
/// OpenCV's plus 0.5.
struct CameraModel {
  double fx_px = 1000.0;
  double fy_px = 1000.0;
  double cx_px = 640.0;
  double cy_px = 360.0;
  std::vector<double> distortion;  ///< OpenCV's order; 0, 4, 5 or 8 of them
};

/// One ArUco marker on a body. A marker's own frame: X right, Y up and Z out of it, from its middle.
struct MarkerOnBody {
  int marker = 0;       ///< its id in the dictionary
  double size_m = 0.0;  ///< of the black square's side
  Rigid body_from_marker;
};

/// A body that carries markers, of which one seen is enough.
struct MarkerBody {
  std::int32_t id = 0;
  std::string name;
  std::vector<MarkerOnBody> markers;
};

/// A body that is a ChArUco board: markers 0, 1, .. in the white squares, row by row from the top left, black squares
/// in the corners. An odd number of rows, since even ones changed between versions of OpenCV. Its frame: X right, Y up
/// and Z out of the board, from its lower left corner.
struct CharucoBody {
  std::int32_t id = 0;
  std::string name;
  int squares_x = 5;
  int squares_y = 7;
  double square_m = 0.0;
  double marker_m = 0.0;  ///< of a marker's black side
};

struct ArucoSettings {
  CameraModel camera;
  std::string dictionary = "4x4_50";
  std::vector<MarkerBody> bodies;
  std::vector<CharucoBody> boards;  ///< one at most: each begins with marker 0
  double most_error_px = 2.0;       ///< root mean square of the reprojection; above it, it is no pose
  /// Of what lies in one plane there are two poses that look alike. The second must fit so many times worse, or lie
  /// within `alike_deg` of the first; else the body is not tracked.
  double least_ratio = 2.0;
  double alike_deg = 5.0;
};

}  // namespace focalstage
