#pragma once

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "devices/aruco/settings.h"

namespace focalstage {

/// Points of a body and where they were seen, in OpenCV's convention of pixels.
struct SeenPoints {
  std::vector<cv::Point3d> body_m;
  std::vector<cv::Point2d> image_px;
};

struct BoardPose {
  Rigid tracker_from_body;  ///< the camera turned to +Y up
  double error_px = 0.0;    ///< root mean square of the reprojection
};

/// The pose that explains what was seen; none where there is none, where it explains it badly, or where another one
/// explains it as well. What lies in one plane by infinitesimal planes (Collins and Bartoli, "Infinitesimal plane-based
/// pose estimation", IJCV 109, 2014), the rest by SQPnP (Terzakis and Lourakis, ECCV 2020), then by least squares.
std::optional<BoardPose> board_pose(const SeenPoints& seen, const ArucoSettings& settings);

}  // namespace focalstage
