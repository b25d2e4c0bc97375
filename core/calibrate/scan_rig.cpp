#include "core/calibrate/scan_rig.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <opencv2/calib3d.hpp>

#include "core/base/number_words.h"
#include "core/calibrate/chance.h"
#include "core/calibrate/first_poses.h"
#include "core/calibrate/projector_fit.h"
#include "core/calibrate/rig_bundle.h"

namespace focalstage {

namespace {

constexpr std::size_t least_views = 4;
constexpr double weakest_focal = 0.02;  // standard deviation, of itself
constexpr double chance = 1e-6;         // of calling a good capture off
constexpr double off_px = 0.5;          // along each axis: what is nearer is not worth a word
constexpr double most_off_px = 10.0;    // along each axis: beyond it, it is no rig
constexpr double rad_to_deg = 180.0 / std::numbers::pi;

using Views = std::vector<BoardView>;

/// OpenCV's camera looks along +Z with +Y down.
Rigid own_from_board(const cv::Mat& turn, const cv::Mat& shift) {
  cv::Matx33d m;
  cv::Rodrigues(turn, m);
  const glm::dmat3 matrix(m(0, 0), m(1, 0), m(2, 0), m(0, 1), m(1, 1), m(2, 1), m(0, 2), m(1, 2), m(2, 2));
  const Rigid pose{{shift.at<double>(0), shift.at<double>(1), shift.at<double>(2)},
                   glm::normalize(glm::quat_cast(matrix))};
  return Rigid{{}, glm::dquat(0.0, 1.0, 0.0, 0.0)} * pose;
}

/// The camera at the origin, and the boards before it, by Zhang's method.
std::optional<RigState> first_camera(int width_px, int height_px, const Views& views) {
  std::vector<std::vector<cv::Point3f>> boards;
  std::vector<std::vector<cv::Point2f>> pixels;
  for (const BoardView& view : views) {
    auto& board = boards.emplace_back();
    auto& picture = pixels.emplace_back();
    for (const SeenCorner& corner : view.corners) {
      board.emplace_back(static_cast<float>(corner.board_m.x), static_cast<float>(corner.board_m.y), 0.0F);
      picture.emplace_back(static_cast<float>(corner.camera_px.x - 0.5), static_cast<float>(corner.camera_px.y - 0.5));
    }
  }
  cv::Mat matrix;
  cv::Mat distortion;
  std::vector<cv::Mat> turns;
  std::vector<cv::Mat> shifts;
  try {
    cv::calibrateCamera(boards, pixels, {width_px, height_px}, matrix, distortion, turns, shifts,
                        cv::CALIB_FIX_K3 | cv::CALIB_ZERO_TANGENT_DIST);
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
  RigState state;
  state.camera = {width_px,
                  height_px,
                  {matrix.at<double>(0, 0), matrix.at<double>(1, 1)},
                  {matrix.at<double>(0, 2) + 0.5, matrix.at<double>(1, 2) + 0.5},
                  {distortion.at<double>(0), distortion.at<double>(1), 0.0, 0.0, 0.0},
                  {}};
  for (std::size_t i = 0; i < views.size(); ++i) state.frame_from_board.push_back(own_from_board(turns[i], shifts[i]));
  return state;
}

/// The projector as all corners of all boards tell it, whatever its lens' shift: in the camera's frame.
std::optional<ProjectorModel> first_projector(const ProjectorModel& known, const RigState& state, const Views& views) {
  std::vector<PickedPoint> points;
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (const SeenCorner& corner : views[i].corners) {
      points.push_back({"", state.frame_from_board[i].point(corner.board_m), corner.projector_px});
    }
  }
  std::optional<ProjectorFit> best;
  for (int step = -6; step <= 6; ++step) {
    ProjectorModel model = known;
    model.distortion.assign(4, 0.0);
    model.focal_px *= std::exp2(0.25 * step);
    for (const Rigid& pose : first_poses(model, points)) {
      model.world_from_projector = pose;
      auto fit = fit_projector(model, points, LensFreedom::centre);
      if (fit && (!best || fit->square_sum_px2 < best->square_sum_px2)) best = std::move(fit);
    }
  }
  if (!best) return std::nullopt;
  return best->model;
}

/// The first board becomes the frame.
void take_first_board_as_frame(RigState& state) {
  const Rigid board_from_camera = state.frame_from_board[0].inverse();
  state.camera.world_from_projector = board_from_camera * state.camera.world_from_projector;
  state.projector.world_from_projector = board_from_camera * state.projector.world_from_projector;
  for (Rigid& board : state.frame_from_board) board = board_from_camera * board;
  state.frame_from_board[0] = Rigid{};
}

Views without(const Views& views, std::size_t left_out) {
  Views rest = views;
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(left_out));
  return rest;
}

RigState without(const RigState& state, std::size_t left_out) {
  RigState rest = state;
  rest.frame_from_board.erase(rest.frame_from_board.begin() + static_cast<std::ptrdiff_t>(left_out));
  if (left_out == 0) take_first_board_as_frame(rest);
  return rest;
}

/// How far the others alone put each corner of a board in the projector's picture, where the camera sees the board.
std::vector<std::optional<double>> left_out_px(const RigFit& rest, const Rigid& near, const BoardView& view) {
  const auto board = board_by_camera(rest.state.camera, near, view);
  std::vector<std::optional<double>> distances;
  for (const SeenCorner& corner : view.corners) {
    std::optional<double>& distance = distances.emplace_back();
    if (!board) continue;
    const auto pixel = pixel_of_world(rest.state.projector, board->point(corner.board_m));
    if (pixel) distance = glm::distance(*pixel, corner.projector_px);
  }
  return distances;
}

using LeftOut = std::vector<std::vector<std::optional<double>>>;

/// Leaves each board out in turn; refuses the one that lies.
Result<LeftOut> leave_each_out(const RigFit& all, const Views& views) {
  LeftOut left_out(views.size());
  const std::array<double, 2> sizes_px{std::max(all.camera_rms_px, 1e-4), std::max(all.projector_rms_px, 1e-4)};
  double least = 1.0;
  std::size_t suspect = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto rest = adjust(without(all.state, i), without(views, i), sizes_px[0], sizes_px[1]);
    if (!rest) continue;
    const Rigid first = i == 0 ? all.state.frame_from_board[1].inverse() : Rigid{};
    left_out[i] = left_out_px(*rest, first * all.state.frame_from_board[i], views[i]);
    const double equations = 2.0 * static_cast<double>(views[i].corners.size() + views[i].face.size()) - 6.0;
    const double p = chance_of_gain(all.square_sum_px2, rest->square_sum_px2, equations, rest->freedom);
    if (p >= least) continue;
    least = p;
    suspect = i;
  }
  if (std::hypot(all.projector_rms_px, all.camera_rms_px) < off_px ||
      least * static_cast<double>(views.size()) >= chance) {
    return left_out;
  }
  return Fault{
      "scan.view-off", views[suspect].name,
      "it disagrees with the other captures: with it, the projector's residual is " +
          fixed_text(all.projector_rms_px, 2) + " px along each axis",
      "camera and projector must not move from the first capture to the last; capture it anew, or leave it out"};
}

std::vector<PointResidual> residuals_of(const ProjectorModel& lens, const RigState& state, const Views& views,
                                        glm::dvec2 SeenCorner::*measured, const LeftOut& left_out) {
  std::vector<PointResidual> residuals;
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (std::size_t k = 0; k < views[i].corners.size(); ++k) {
      const SeenCorner& corner = views[i].corners[k];
      const auto pixel = pixel_of_world(lens, state.frame_from_board[i].point(corner.board_m));
      PointResidual residual{views[i].name + "/" + std::to_string(corner.number), corner.*measured, {}, 0.0, {}};
      if (pixel) residual.off_px = *pixel - corner.*measured;
      if (k < left_out[i].size()) residual.left_out_px = left_out[i][k];
      residuals.push_back(std::move(residual));
    }
  }
  return residuals;
}

PoseUncertainty uncertainty_of(const RigFit& fit) {
  const Eigen::VectorXd variance = fit.projector_covariance.diagonal();
  return {1e3 * std::sqrt(variance.tail(3).sum()), rad_to_deg * std::sqrt(variance.head(3).sum()), std::nullopt,
          std::nullopt};
}

/// Drops strays from the views.
Result<RigFit> first_fit(const ProjectorModel& known, int width_px, int height_px, Views& views) {
  const Fault unsolved{"scan.unsolved", "boards", "no camera and projector agree with all captures",
                       "see that the board is as it is described, and that neither was moved between the captures"};
  auto state = first_camera(width_px, height_px, views);
  if (!state) return unsolved;
  const auto projector = first_projector(known, *state, views);
  if (!projector) return unsolved;
  state->projector = *projector;
  take_first_board_as_frame(*state);
  auto fit = adjust(*state, views);
  if (fit) {
    drop_stray(fit->state, views);
    fit = adjust(fit->state, views);
  }
  if (!fit || !(std::max(fit->camera_rms_px, fit->projector_rms_px) < most_off_px)) return unsolved;
  return std::move(*fit);
}

}  // namespace

Result<ScanRig> solve_scan_rig(const ProjectorModel& known, int camera_width_px, int camera_height_px,
                               const Views& seen) {
  if (seen.size() < least_views) {
    return Fault{"scan.few", "boards", "there are " + std::to_string(seen.size()) + " captures of a board",
                 "capture it four times at least, better eight, each time leaning another way"};
  }
  Views views = seen;
  const auto fit = first_fit(known, camera_width_px, camera_height_px, views);
  if (!fit) return fit.fault();
  if (fit->focal_share > weakest_focal) {
    return Fault{"scan.alike", "boards",
                 "they tell a focal length to " + fixed_text(100.0 * fit->focal_share, 0) + " % alone",
                 "let the board lean by 20 to 40 degrees, each time another way, and fill the picture"};
  }
  auto left_out = leave_each_out(*fit, views);
  if (!left_out) return left_out.fault();
  ScanRig rig{fit->state.camera, fit->state.projector, fit->state.frame_from_board, {}, {}};
  rig.report = report_of(residuals_of(rig.projector, fit->state, views, &SeenCorner::projector_px, *left_out),
                         known.width_px, known.height_px);
  rig.report.uncertainty = uncertainty_of(*fit);
  rig.camera_report =
      report_of(residuals_of(rig.camera, fit->state, views, &SeenCorner::camera_px, LeftOut(views.size())),
                camera_width_px, camera_height_px);
  return rig;
}

}  // namespace focalstage
