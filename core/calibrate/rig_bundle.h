#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/calibrate/scan_rig.h"

namespace focalstage {

// The room's own: what includes this sees Eigen.

/// What a bundle adjustment finds: everything but the first board, which is the frame.
struct RigState {
  ProjectorModel camera;
  ProjectorModel projector;
  std::vector<Rigid> frame_from_board;
};

struct RigFit {
  RigState state;
  double camera_rms_px = 0.0;     ///< along each axis, over corners
  double projector_rms_px = 0.0;  ///< along each axis, over places on faces
  double square_sum_px2 = 0.0;    ///< in the projector's pixels; the camera's residuals as they were weighed
  double freedom = 0.0;
  Eigen::MatrixXd projector_covariance;  ///< turn (rad) and position (m)
  double focal_share = 0.0;              ///< the larger standard deviation of the focal lengths, of themselves
};

/// From `start` downhill, the residuals of camera and projector weighed by how large they turn out to be. None where a
/// corner is behind either, or something is not determined.
std::optional<RigFit> adjust(const RigState& start, const std::vector<BoardView>& views);

/// The same with the sizes of both told.
std::optional<RigFit> adjust(const RigState& start, const std::vector<BoardView>& views, double camera_px,
                             double projector_px);

/// Drops the corners and places that lie off by more than four times what most do, where a shadow's edge or a glint was
/// taken for a corner; at most a fifth of each board's.
void drop_stray(const RigState& state, std::vector<BoardView>& views);

/// The pose of a board by the camera alone.
std::optional<Rigid> board_by_camera(const ProjectorModel& camera, const Rigid& near, const BoardView& view);

}  // namespace focalstage
