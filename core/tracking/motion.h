#pragma once

#include <deque>
#include <optional>

#include <glm/vec3.hpp>

#include "core/base/rigid.h"

namespace focalstage {

/// A body at one moment.
struct PoseSample {
  double clock_s = 0.0;  ///< on the tracker's clock, which has no jitter: velocities come from it
  double seen_s = 0.0;   ///< the same moment on the clock that predictions are asked in
  bool tracked = false;
  Rigid pose;
};

/// What is taken for motion, and how far it is trusted.
struct MotionLimits {
  double window_s = 0.05;      ///< samples so old take part in the velocity; what a tracker's noise is averaged over
  double most_gap_s = 0.1;     ///< between samples: what was before a longer one says nothing of now
  double most_ahead_s = 0.15;  ///< of the newest sample: more than poses take to become light; no further than that
  double most_speed_m_s = 5.0;
  double most_turn_rad_s = 20.0;  ///< faster than either from one sample to the next is a jump, not a motion
};

/// Says where a body will be: as if it kept the velocity, in position and rotation, that it had over the window. The
/// velocity is the slope of the least squares line (of positions; of rotation vectors from the newest sample), the line
/// goes through the newest sample.
///
/// On a circle with an acceleration of a, a prediction by t is off by at most a t (t + window) / 2.
class Motion {
 public:
  explicit Motion(const MotionLimits& limits = {}) : limits_(limits) {}

  /// In order of time; one that is no newer than the newest is passed over, unless the clock went back by more than the
  /// window: then the tracker began anew. One where it was not tracked ends all that was known of its motion.
  void add(const PoseSample& sample);

  /// None unless it was tracked in the newest sample. Never before that sample's own moment.
  std::optional<Rigid> at(double time_s) const;

 private:
  bool jumped(const PoseSample& from, const PoseSample& to) const;

  MotionLimits limits_;
  std::deque<PoseSample> samples_;  ///< all tracked, without a jump among them
  glm::dvec3 velocity_m_s_{0.0};
  glm::dvec3 turning_rad_s_{0.0};  ///< about an axis of the world that poses are told in
};

/// Axis times angle in rad, by the shorter way.
glm::dvec3 rotation_vector(const glm::dquat& rotation);
glm::dquat rotation_by(const glm::dvec3& vector_rad);

}  // namespace focalstage
