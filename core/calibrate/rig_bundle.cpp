#include "core/calibrate/rig_bundle.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include "core/calibrate/least_squares.h"
#include "core/calibrate/projector_fit.h"
#include "core/calibrate/rigid_step.h"

namespace focalstage {

namespace {

// Unknowns: the camera's lens, the projector's, the camera's pose, the projector's, those of the second board and on.
constexpr Eigen::Index camera_lens = 9;     // fx fy cx cy k1 k2 p1 p2 k3
constexpr Eigen::Index projector_lens = 8;  // without k3
constexpr Eigen::Index pose = 6;
constexpr double stray = 4.0;  // medians: two in a million of what is noisy alone
constexpr int most_steps = 40;
constexpr double same_px = 1e-8;
constexpr Eigen::Index poses_at = camera_lens + projector_lens;

ProjectorModel bent(const ProjectorModel& start, const Eigen::Ref<const Eigen::VectorXd>& by) {
  ProjectorModel lens = start;
  lens.focal_px += glm::dvec2(by(0), by(1));
  lens.centre_px += glm::dvec2(by(2), by(3));
  for (Eigen::Index i = 4; i < by.size(); ++i) lens.distortion[static_cast<std::size_t>(i - 4)] += by(i);
  return lens;
}

RigState changed(const RigState& start, const Eigen::VectorXd& by) {
  RigState state{bent(start.camera, by.head(camera_lens)),
                 bent(start.projector, by.segment(camera_lens, projector_lens)), start.frame_from_board};
  state.camera.world_from_projector = stepped(start.camera.world_from_projector, by.segment(poses_at, pose));
  state.projector.world_from_projector =
      stepped(start.projector.world_from_projector, by.segment(poses_at + pose, pose));
  for (std::size_t i = 1; i < state.frame_from_board.size(); ++i) {
    const Eigen::Index at = poses_at + pose * static_cast<Eigen::Index>(i + 1);
    state.frame_from_board[i] = stepped(start.frame_from_board[i], by.segment(at, pose));
  }
  return state;
}

Eigen::VectorXd scale_of(const RigState& start) {
  Eigen::VectorXd scale =
      Eigen::VectorXd::Ones(poses_at + pose * static_cast<Eigen::Index>(start.frame_from_board.size() + 1));
  scale.head(4).setConstant(start.camera.focal_px.x);
  scale.segment(camera_lens, 4).setConstant(start.projector.focal_px.x);
  return scale;
}

/// The unknowns that one board's residuals take: everything but the other boards.
std::vector<Eigen::Index> unknowns_of_board(std::size_t board) {
  std::vector<Eigen::Index> unknowns(static_cast<std::size_t>(poses_at + 2 * pose));
  std::iota(unknowns.begin(), unknowns.end(), Eigen::Index{0});
  if (board == 0) return unknowns;  // it is the frame
  const Eigen::Index at = poses_at + pose * static_cast<Eigen::Index>(board + 1);
  for (Eigen::Index i = 0; i < pose; ++i) unknowns.push_back(at + i);
  return unknowns;
}

/// One board's residuals: its corners in the camera's picture, and its face's places in the projector's, where the
/// camera's rays through their pixels meet it. A corner is as unsure in the projector's picture as in the camera's, by
/// the same error: it has no second say.
class BoardResiduals {
 public:
  BoardResiduals(const BoardView& view, double camera_px, double projector_px)
      : view_(view), camera_px_(camera_px), projector_px_(projector_px) {}

  bool operator()(const RigState& state, const Rigid& frame_from_board, Eigen::VectorXd& out) {
    out.resize(2 * static_cast<Eigen::Index>(view_.corners.size() + view_.face.size()));
    Eigen::Index at = 0;
    for (const SeenCorner& corner : view_.corners) {
      const auto seen = pixel_of_world(state.camera, frame_from_board.point(corner.board_m));
      if (!seen) return false;
      const glm::dvec2 off = (*seen - corner.camera_px) / camera_px_;
      out.segment<2>(at) << off.x, off.y;
      at += 2;
    }
    look_along(state.camera);
    const Rigid board_from_camera = frame_from_board.inverse() * state.camera.world_from_projector;
    for (std::size_t i = 0; i < view_.face.size(); ++i) {
      const glm::dvec3 along = board_from_camera.direction(glm::dvec3(looks_[i], -1.0));
      const glm::dvec3& from = board_from_camera.position_m;
      const glm::dvec3 place = from - from.z / along.z * along;
      const auto lit = pixel_of_world(state.projector, frame_from_board.point(place));
      if (!lit) return false;
      const glm::dvec2 off = (*lit - view_.face[i].projector_px) / projector_px_;
      out.segment<2>(at) << off.x, off.y;
      at += 2;
    }
    return true;
  }

 private:
  /// The camera's own rays change with its lens alone.
  void look_along(const ProjectorModel& camera) {
    const bool same = camera.focal_px == lens_.focal_px && camera.centre_px == lens_.centre_px &&
                      camera.distortion == lens_.distortion && !looks_.empty();
    if (same) return;
    if (looks_.empty()) {
      for (const FacePlace& place : view_.face) looks_.push_back(tangent_of_pixel(camera, place.camera_px));
    }
    lens_ = camera;
    // From where the last lens had them it is not far.
    for (std::size_t i = 0; i < looks_.size(); ++i) {
      for (int step = 0; step < most_steps; ++step) {
        const glm::dvec2 off = view_.face[i].camera_px - pixel_of_tangent(camera, looks_[i]);
        looks_[i] += glm::dvec2(off.x, -off.y) / camera.focal_px;
        if (std::abs(off.x) + std::abs(off.y) < same_px) break;
      }
    }
  }

  const BoardView& view_;
  double camera_px_;
  double projector_px_;
  ProjectorModel lens_;
  std::vector<glm::dvec2> looks_;
};

std::vector<ResidualBlock> blocks_of(const RigState& from, const std::vector<BoardView>& views, double camera_px,
                                     double projector_px) {
  std::vector<ResidualBlock> blocks;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto residuals = std::make_shared<BoardResiduals>(views[i], camera_px, projector_px);
    blocks.push_back({unknowns_of_board(i), [&from, residuals, i](const Eigen::VectorXd& by, Eigen::VectorXd& out) {
                        const RigState state = changed(from, by);
                        return (*residuals)(state, state.frame_from_board[i], out);
                      }});
  }
  return blocks;
}

/// Root mean square along each axis, of the camera and of the projector; weights undone.
std::pair<double, double> sizes(const Eigen::VectorXd& residuals, const std::vector<BoardView>& views, double camera_px,
                                double projector_px) {
  double camera = 0.0;
  double projector = 0.0;
  Eigen::Index of_camera = 0;
  Eigen::Index at = 0;
  for (const BoardView& view : views) {
    const auto corners = 2 * static_cast<Eigen::Index>(view.corners.size());
    const auto face = 2 * static_cast<Eigen::Index>(view.face.size());
    camera += residuals.segment(at, corners).squaredNorm();
    projector += residuals.segment(at + corners, face).squaredNorm();
    of_camera += corners;
    at += corners + face;
  }
  return {camera_px * std::sqrt(camera / static_cast<double>(of_camera)),
          projector_px * std::sqrt(projector / static_cast<double>(at - of_camera))};
}

/// Of so many pairs of residuals.
std::vector<double> lengths(const Eigen::VectorXd& residuals, std::size_t first, std::size_t count) {
  std::vector<double> all;
  for (std::size_t i = first; i < first + count; ++i) {
    all.push_back(residuals.segment<2>(2 * static_cast<Eigen::Index>(i)).norm());
  }
  return all;
}

double median_of_all(const std::vector<std::vector<double>>& lists) {
  std::vector<double> all;
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::ranges::nth_element(all, middle);
  return *middle;
}

template <class Item>
void drop(std::vector<Item>& items, const std::vector<double>& off_px, double most_px) {
  std::vector<Item> kept;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (off_px[i] <= most_px) kept.push_back(items[i]);
  }
  if (5 * kept.size() >= 4 * items.size()) items = std::move(kept);
}

}  // namespace

std::optional<RigFit> adjust(const RigState& start, const std::vector<BoardView>& views) {
  auto fit = adjust(start, views, 1.0, 1.0);
  for (int round = 0; fit && round < 2; ++round) {
    fit = adjust(fit->state, views, std::max(fit->camera_rms_px, 1e-4), std::max(fit->projector_rms_px, 1e-4));
  }
  return fit;
}

std::optional<RigFit> adjust(const RigState& from, const std::vector<BoardView>& views, double camera_px,
                             double projector_px) {
  const Eigen::VectorXd scale = scale_of(from);
  const auto solved =
      least_squares(blocks_of(from, views, camera_px, projector_px), Eigen::VectorXd::Zero(scale.size()), scale);
  if (!solved) return std::nullopt;
  RigFit fit;
  fit.state = changed(from, solved->unknowns);
  fit.freedom = static_cast<double>(solved->residuals.size() - solved->unknowns.size());
  fit.projector_covariance = solved->covariance.block<6, 6>(poses_at + pose, poses_at + pose);
  for (const Eigen::Index at : {Eigen::Index{0}, Eigen::Index{1}, camera_lens, camera_lens + 1}) {
    const double focal = at < camera_lens ? fit.state.camera.focal_px.x : fit.state.projector.focal_px.x;
    fit.focal_share = std::max(fit.focal_share, std::sqrt(solved->covariance(at, at)) / focal);
  }
  std::tie(fit.camera_rms_px, fit.projector_rms_px) = sizes(solved->residuals, views, camera_px, projector_px);
  fit.square_sum_px2 = solved->square_sum() * projector_px * projector_px;
  return fit;
}

void drop_stray(const RigState& state, std::vector<BoardView>& views) {
  std::vector<std::vector<double>> corners;
  std::vector<std::vector<double>> faces;
  for (std::size_t i = 0; i < views.size(); ++i) {
    Eigen::VectorXd off;
    BoardResiduals residuals(views[i], 1.0, 1.0);
    if (!residuals(state, state.frame_from_board[i], off)) return;
    corners.push_back(lengths(off, 0, views[i].corners.size()));
    faces.push_back(lengths(off, views[i].corners.size(), views[i].face.size()));
  }
  const double most_corner_px = stray * median_of_all(corners);
  const double most_face_px = stray * median_of_all(faces);
  for (std::size_t i = 0; i < views.size(); ++i) {
    drop(views[i].corners, corners[i], most_corner_px);
    drop(views[i].face, faces[i], most_face_px);
  }
}

std::optional<Rigid> board_by_camera(const ProjectorModel& camera, const Rigid& near, const BoardView& view) {
  const auto residuals = [&](const Eigen::VectorXd& by, Eigen::VectorXd& out) {
    const Rigid frame_from_board = stepped(near, by);
    out.resize(2 * static_cast<Eigen::Index>(view.corners.size()));
    for (std::size_t i = 0; i < view.corners.size(); ++i) {
      const auto seen = pixel_of_world(camera, frame_from_board.point(view.corners[i].board_m));
      if (!seen) return false;
      out.segment<2>(2 * static_cast<Eigen::Index>(i)) << seen->x - view.corners[i].camera_px.x,
          seen->y - view.corners[i].camera_px.y;
    }
    return true;
  };
  const auto solved = least_squares(residuals, Eigen::VectorXd::Zero(pose), Eigen::VectorXd::Ones(pose));
  if (!solved) return std::nullopt;
  return stepped(near, solved->unknowns);
}

}  // namespace focalstage
