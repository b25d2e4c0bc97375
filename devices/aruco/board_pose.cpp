#include "devices/aruco/board_pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <opencv2/calib3d.hpp>

namespace focalstage {

namespace {

// Off a plane by less than this share of their extent, points lie in it.
constexpr double flat = 1e-6;

struct Candidate {
  cv::Mat turn;
  cv::Mat shift;
  double error_px = 0.0;
};

cv::Matx33d camera_matrix(const CameraModel& camera) {
  return {camera.fx_px, 0.0, camera.cx_px - 0.5, 0.0, camera.fy_px, camera.cy_px - 0.5, 0.0, 0.0, 1.0};
}

/// The points about their middle, along their own axes: the longest first.
struct OwnFrame {
  cv::Vec3d middle;
  cv::Matx33d own_from_body;  ///< right-handed
  std::vector<cv::Point3d> points;
  bool flat = false;
};

OwnFrame own_frame(const std::vector<cv::Point3d>& points) {
  OwnFrame own;
  for (const cv::Point3d& p : points) own.middle += cv::Vec3d(p.x, p.y, p.z) / static_cast<double>(points.size());
  cv::Matx33d spread = cv::Matx33d::zeros();
  for (const cv::Point3d& p : points) {
    const cv::Vec3d off = cv::Vec3d(p.x, p.y, p.z) - own.middle;
    spread += off * off.t();
  }
  cv::Vec3d squares;
  cv::eigen(spread, squares, own.own_from_body);
  if (cv::determinant(own.own_from_body) < 0.0) own.own_from_body *= -1.0;
  own.flat = std::abs(squares[2]) < flat * flat * squares[0];
  for (const cv::Point3d& p : points) {
    const cv::Vec3d at = own.own_from_body * (cv::Vec3d(p.x, p.y, p.z) - own.middle);
    own.points.emplace_back(at[0], at[1], own.flat ? 0.0 : at[2]);
  }
  return own;
}

/// Turned back to the body's own frame.
Candidate of_body(const cv::Mat& turn, const cv::Mat& shift, const OwnFrame& own) {
  cv::Matx33d camera_from_own;
  cv::Rodrigues(turn, camera_from_own);
  const cv::Matx33d camera_from_body = camera_from_own * own.own_from_body;
  const cv::Vec3d at = cv::Vec3d(shift) - camera_from_body * own.middle;
  Candidate pose;
  cv::Rodrigues(camera_from_body, pose.turn);
  pose.shift = cv::Mat(at, true);
  return pose;
}

double error_px(const SeenPoints& seen, const Candidate& pose, const CameraModel& camera) {
  std::vector<cv::Point2d> projected;
  cv::projectPoints(seen.body_m, pose.turn, pose.shift, camera_matrix(camera), camera.distortion, projected);
  double square_sum = 0.0;
  for (std::size_t i = 0; i < projected.size(); ++i) {
    const cv::Point2d off = projected[i] - seen.image_px[i];
    square_sum += off.dot(off);
  }
  return std::sqrt(square_sum / static_cast<double>(projected.size()));
}

bool in_front(const SeenPoints& seen, const Candidate& pose) {
  cv::Matx33d turn;
  cv::Rodrigues(pose.turn, turn);
  return std::ranges::all_of(seen.body_m, [&](const cv::Point3d& p) {
    return turn(2, 0) * p.x + turn(2, 1) * p.y + turn(2, 2) * p.z + pose.shift.at<double>(2) > 0.0;
  });
}

/// The best first.
std::vector<Candidate> candidates(const SeenPoints& seen, const CameraModel& camera) {
  const cv::Matx33d matrix = camera_matrix(camera);
  // OpenCV 4.6 misplaces planes that do not go through the origin: it is given none.
  const OwnFrame own = own_frame(seen.body_m);
  std::vector<cv::Mat> turns;
  std::vector<cv::Mat> shifts;
  cv::solvePnPGeneric(own.points, seen.image_px, matrix, camera.distortion, turns, shifts, false,
                      own.flat ? cv::SOLVEPNP_IPPE : cv::SOLVEPNP_SQPNP);
  std::vector<Candidate> found;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    Candidate pose = of_body(turns[i], shifts[i], own);
    cv::solvePnPRefineLM(seen.body_m, seen.image_px, matrix, camera.distortion, pose.turn, pose.shift);
    pose.error_px = error_px(seen, pose, camera);
    if (std::isfinite(pose.error_px) && in_front(seen, pose)) found.push_back(std::move(pose));
  }
  std::ranges::sort(found, {}, &Candidate::error_px);
  return found;
}

double angle_deg(const Candidate& a, const Candidate& b) {
  cv::Matx33d first;
  cv::Matx33d second;
  cv::Rodrigues(a.turn, first);
  cv::Rodrigues(b.turn, second);
  const double cosine = 0.5 * (cv::trace(first.t() * second) - 1.0);
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

/// From OpenCV's camera (+Y down, looking along +Z) to the tracker's frame: half a turn about X.
Rigid tracker_from(const Candidate& pose) {
  cv::Matx33d turn;
  cv::Rodrigues(pose.turn, turn);
  const glm::dmat3 matrix(turn(0, 0), turn(1, 0), turn(2, 0), turn(0, 1), turn(1, 1), turn(2, 1), turn(0, 2),
                          turn(1, 2), turn(2, 2));
  const Rigid camera_from_body{{pose.shift.at<double>(0), pose.shift.at<double>(1), pose.shift.at<double>(2)},
                               glm::normalize(glm::quat_cast(matrix))};
  return Rigid{{}, glm::dquat(0.0, 1.0, 0.0, 0.0)} * camera_from_body;
}

}  // namespace

std::optional<BoardPose> board_pose(const SeenPoints& seen, const ArucoSettings& settings) {
  if (seen.body_m.size() < 4) return std::nullopt;
  try {
    const std::vector<Candidate> found = candidates(seen, settings.camera);
    if (found.empty() || found[0].error_px > settings.most_error_px) return std::nullopt;
    for (std::size_t i = 1; i < found.size(); ++i) {
      const bool as_good = found[i].error_px < settings.least_ratio * found[0].error_px;
      if (as_good && angle_deg(found[0], found[i]) > settings.alike_deg) return std::nullopt;
    }
    return BoardPose{tracker_from(found[0]), found[0].error_px};
  } catch (const cv::Exception&) {
    return std::nullopt;  // points that no solver takes, on one line for instance
  }
}

}  // namespace focalstage
