#pragma once

#include <Eigen/Core>
#include <glm/geometric.hpp>

#include "core/base/rigid.h"

namespace focalstage {

// The room's own: what includes this sees Eigen.

/// A pose changed by six numbers: a turn about its own axes (rad, axis times angle), then a step in its parent, in
/// metres.
inline Rigid stepped(const Rigid& start, const Eigen::Ref<const Eigen::VectorXd>& by) {
  Rigid rigid = start;
  const glm::dvec3 turn(by(0), by(1), by(2));
  const double angle = glm::length(turn);
  if (angle > 0.0) rigid.rotation = glm::normalize(start.rotation * glm::angleAxis(angle, turn / angle));
  rigid.position_m += glm::dvec3(by(3), by(4), by(5));
  return rigid;
}

}  // namespace focalstage
