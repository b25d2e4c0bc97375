#include "core/calibrate/first_poses.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <glm/geometric.hpp>
#include <glm/gtx/quaternion.hpp>
#include <opencv2/calib3d.hpp>

namespace focalstage {

namespace {

/// OpenCV's camera looks along +Z with +Y down: half a turn about X.
const glm::dquat projector_from_opencv{0.0, 1.0, 0.0, 0.0};

Rigid world_from_projector(const cv::Mat& turn, const cv::Mat& shift) {
  cv::Matx33d matrix;
  cv::Rodrigues(turn, matrix);
  const glm::dmat3 opencv_from_world(matrix(0, 0), matrix(1, 0), matrix(2, 0), matrix(0, 1), matrix(1, 1), matrix(2, 1),
                                     matrix(0, 2), matrix(1, 2), matrix(2, 2));
  const Rigid pose{{shift.at<double>(0), shift.at<double>(1), shift.at<double>(2)},
                   glm::normalize(glm::quat_cast(opencv_from_world))};
  return (Rigid{{}, projector_from_opencv} * pose).inverse();
}

glm::dvec3 middle_of(const std::vector<PickedPoint>& points) {
  glm::dvec3 middle(0.0);
  for (const PickedPoint& point : points) middle += point.world_m / static_cast<double>(points.size());
  return middle;
}

/// The direction in which the points spread least.
glm::dvec3 flattest(const std::vector<PickedPoint>& points, const glm::dvec3& middle) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const PickedPoint& point : points) {
    const glm::dvec3 off = point.world_m - middle;
    const Eigen::Vector3d v(off.x, off.y, off.z);
    spread += v * v.transpose();
  }
  const Eigen::Vector3d least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
  return {least.x(), least.y(), least.z()};
}

}  // namespace

std::vector<Rigid> first_poses(const ProjectorModel& known, const std::vector<PickedPoint>& points) {
  // OpenCV sees tangents alone: pixels and distortion stay in our own hands.
  const glm::dvec3 middle = middle_of(points);
  std::vector<cv::Point3d> world;
  std::vector<cv::Point2d> tangents;
  for (const PickedPoint& point : points) {
    const glm::dvec3 at = point.world_m - middle;
    const glm::dvec2 tangent = tangent_of_pixel(known, point.pixel);
    world.emplace_back(at.x, at.y, at.z);
    tangents.emplace_back(tangent.x, -tangent.y);
  }
  std::vector<Rigid> poses;
  try {
    std::vector<cv::Mat> turns;
    std::vector<cv::Mat> shifts;
    cv::solvePnPGeneric(world, tangents, cv::Matx33d::eye(), cv::noArray(), turns, shifts, false, cv::SOLVEPNP_SQPNP);
    for (std::size_t i = 0; i < turns.size(); ++i) {
      poses.push_back(Rigid{middle, glm::dquat(1.0, 0.0, 0.0, 0.0)} * world_from_projector(turns[i], shifts[i]));
    }
  } catch (const cv::Exception&) {
    return {};
  }
  std::erase_if(poses, [](const Rigid& pose) {
    return !std::isfinite(glm::length(pose.position_m) + glm::length(pose.rotation));
  });
  return poses;
}

Rigid leaning_the_other_way(const Rigid& pose, const std::vector<PickedPoint>& points) {
  const glm::dvec3 middle = middle_of(points);
  const glm::dvec3 normal = flattest(points, middle);
  const glm::dvec3 sight = glm::normalize(pose.position_m - middle);
  // Half a turn about the line of sight takes the normal to where the other pose has it.
  const glm::dvec3 other = 2.0 * glm::dot(normal, sight) * sight - normal;
  const Rigid turn{{}, glm::rotation(normal, other)};
  const Rigid about_middle = Rigid{middle, {1, 0, 0, 0}} * turn * Rigid{-middle, {1, 0, 0, 0}};
  return about_middle.inverse() * pose;
}

}  // namespace focalstage
