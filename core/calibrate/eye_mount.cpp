#include "core/calibrate/eye_mount.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <glm/geometric.hpp>

#include "core/optics/eye_rotation.h"

namespace focalstage {
namespace {

constexpr std::size_t least_count = 4;  ///< of an eye: three could agree by chance
constexpr double least_apart_m = 0.05;
constexpr double least_spread = 0.0027;  ///< mean square of the sine of 3 degrees
constexpr double nearest_eyes_mm = 40.0;
constexpr double farthest_eyes_mm = 85.0;
constexpr double least_alike = 0.7;  ///< cosine of 45 degrees

/// The way of a sighting in the body's axes.
struct Way {
  Eigen::Vector3d from_m;   ///< the mark
  Eigen::Vector3d towards;  ///< unit, from spot to mark
  Eigen::Matrix3d across() const { return Eigen::Matrix3d::Identity() - towards * towards.transpose(); }
};

struct Centre {
  Eigen::Vector3d at_m;
  Eigen::Matrix3d covariance;  ///< for residuals of variance one
};

Eigen::Vector3d eigen(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
glm::dvec3 glm_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

Status check(const std::vector<Sighting>& sightings) {
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const Sighting& sighting = sightings[i];
    const std::string where = "sighting " + sighting_label(sightings, i);
    const double turn = glm::length(sighting.world_from_body.rotation);
    if (!finite(sighting.world_from_body.position_m) || !finite(sighting.mark_m) || !finite(sighting.spot_m) ||
        !(std::abs(turn - 1.0) < 1e-3)) {
      return Fault{"sightings.finite", where, "has a number or a rotation that is none", "write it anew"};
    }
    if (glm::distance(sighting.mark_m, sighting.spot_m) < least_apart_m) {
      return Fault{"sightings.near", where, "has mark and spot less than 5 cm apart",
                   "put the mark farther before the surface"};
    }
  }
  return {};
}

Way way_of(const Sighting& sighting) {
  const Rigid body_from_world = sighting.world_from_body.inverse();
  const glm::dvec3 towards = glm::normalize(sighting.mark_m - sighting.spot_m);
  return {eigen(body_from_world.point(sighting.mark_m)), eigen(body_from_world.direction(towards))};
}

Result<Centre> centre_of(const std::vector<Way>& ways, const std::string& eye) {
  if (ways.size() < least_count) {
    return Fault{"sightings.few", "the " + eye + " eye", "has " + std::to_string(ways.size()) + " sightings",
                 "take four or more with each eye, the head turned another way each time"};
  }
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Way& way : ways) {
    normal += way.across();
    right += way.across() * way.from_m;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(normal);
  if (!(spread.eigenvalues()(0) > least_spread * static_cast<double>(ways.size()))) {
    return Fault{"sightings.parallel", "the " + eye + " eye", "always looked the same way out of the glasses",
                 "turn the head by 10 degrees and more, left, right, up and down, while looking at the mark"};
  }
  const Eigen::Matrix3d covariance = normal.inverse();
  return Centre{covariance * right, covariance};
}

glm::dquat turned_to(const glm::dquat& nominal, const glm::dvec3& axis) {
  const glm::dvec3 from = nominal * glm::dvec3(1.0, 0.0, 0.0);
  const glm::dquat half(1.0 + glm::dot(from, axis), glm::cross(from, axis));
  return glm::normalize(half) * nominal;
}

Status place_viewer(const glm::dquat& nominal, EyeMount& mount) {
  const glm::dvec3 apart_m = mount.centre_m.right - mount.centre_m.left;
  mount.interpupillary_mm = glm::length(apart_m) * 1e3;
  const glm::dvec3 axis = glm::normalize(apart_m);
  if (!(mount.interpupillary_mm > nearest_eyes_mm && mount.interpupillary_mm < farthest_eyes_mm) ||
      !(glm::dot(axis, nominal * glm::dvec3(1.0, 0.0, 0.0)) > least_alike)) {
    return Fault{"sightings.eyes", "the sightings",
                 "put the eyes " + std::to_string(std::lround(mount.interpupillary_mm)) +
                     " mm apart, or not side by side as the body is turned",
                 "see that left and right are not exchanged, and how the body is turned on the glasses"};
  }
  const glm::dquat turn = turned_to(nominal, axis);
  const glm::dvec3 middle_m = (mount.centre_m.left + mount.centre_m.right) / 2.0;
  mount.body_from_viewer = {middle_m + turn * glm::dvec3(0.0, 0.0, -pupil_to_centre_m), turn};
  return {};
}

}  // namespace

std::string sighting_label(const std::vector<Sighting>& sightings, std::size_t index) {
  const std::string& name = sightings[index].name;
  return std::to_string(index + 1) + (name.empty() ? "" : " (" + name + ")");
}

Result<EyeMount> eye_mount(const std::vector<Sighting>& sightings, const glm::dquat& body_from_viewer) {
  if (Status good = check(sightings); !good) return good.fault();
  PerEye<std::vector<Way>> ways;
  for (const Sighting& sighting : sightings) ways[sighting.eye].push_back(way_of(sighting));
  EyeMount mount;
  PerEye<Centre> centres;
  for (const Side eye : both_sides) {
    const auto centre = centre_of(ways[eye], eye == Side::left ? "left" : "right");
    if (!centre) return centre.fault();
    centres[eye] = *centre;
    mount.centre_m[eye] = glm_of(centre->at_m);
  }
  double squares = 0.0;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const Way way = way_of(sightings[i]);
    const Eigen::Vector3d from_mark = centres[sightings[i].eye].at_m - way.from_m;
    if (!(from_mark.dot(way.towards) > 0.0)) {
      return Fault{"sightings.behind", "sighting " + sighting_label(sightings, i), "leads away from the eye",
                   "see that mark and spot are not exchanged"};
    }
    const double off_m = (way.across() * from_mark).norm();
    squares += off_m * off_m;
    mount.residual_mm.push_back(off_m * 1e3);
  }
  const double count = static_cast<double>(sightings.size());
  mount.rms_mm = std::sqrt(squares / count) * 1e3;
  mount.worst = static_cast<std::size_t>(std::max_element(mount.residual_mm.begin(), mount.residual_mm.end()) -
                                         mount.residual_mm.begin());
  // A sighting brings two equations, an eye three unknowns.
  const double variance = squares / (2.0 * count - 6.0);
  for (const Side eye : both_sides) {
    mount.uncertainty_m[eye] = glm_of((variance * centres[eye].covariance.diagonal()).cwiseSqrt());
  }
  if (Status placed = place_viewer(body_from_viewer, mount); !placed) return placed.fault();
  const Eigen::Vector3d axis = eigen(glm::normalize(mount.centre_m.right - mount.centre_m.left));
  const Eigen::Matrix3d both = centres.left.covariance + centres.right.covariance;
  mount.interpupillary_uncertainty_mm = std::sqrt(variance * axis.dot(both * axis)) * 1e3;
  return mount;
}

}  // namespace focalstage
