#include "core/tracking/motion.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace focalstage {

namespace {

/// The slope of values over times, where they are no less than two moments.
class Slope {
 public:
  void add(double time_s, const glm::dvec3& value) {
    ++count_;
    time_ += time_s;
    time_time_ += time_s * time_s;
    value_ += value;
    time_value_ += time_s * value;
  }

  glm::dvec3 per_s() const {
    const double spread = count_ * time_time_ - time_ * time_;
    return spread > 0.0 ? (count_ * time_value_ - time_ * value_) / spread : glm::dvec3(0.0);
  }

 private:
  double count_ = 0.0;
  double time_ = 0.0;
  double time_time_ = 0.0;
  glm::dvec3 value_{0.0};
  glm::dvec3 time_value_{0.0};
};

}  // namespace

glm::dvec3 rotation_vector(const glm::dquat& rotation) {
  const glm::dquat q = rotation.w < 0.0 ? -rotation : rotation;
  const glm::dvec3 axis(q.x, q.y, q.z);
  const double sine = glm::length(axis);
  // 2 atan2(s, w) / s tends to 2 / w.
  return axis * (sine > 1e-12 ? 2.0 * std::atan2(sine, q.w) / sine : 2.0);
}

glm::dquat rotation_by(const glm::dvec3& vector_rad) {
  const double angle = glm::length(vector_rad);
  if (angle < 1e-12) return glm::normalize(glm::dquat(1.0, 0.5 * vector_rad));
  return {std::cos(0.5 * angle), std::sin(0.5 * angle) / angle * vector_rad};
}

bool Motion::jumped(const PoseSample& from, const PoseSample& to) const {
  const double passed_s = to.clock_s - from.clock_s;
  const double way_m = glm::distance(from.pose.position_m, to.pose.position_m);
  const double turn_rad = glm::length(rotation_vector(to.pose.rotation * glm::conjugate(from.pose.rotation)));
  return way_m > limits_.most_speed_m_s * passed_s || turn_rad > limits_.most_turn_rad_s * passed_s;
}

void Motion::add(const PoseSample& sample) {
  if (!samples_.empty()) {
    const PoseSample& newest = samples_.back();
    const double passed_s = sample.clock_s - newest.clock_s;
    if (passed_s <= 0.0 && passed_s >= -limits_.window_s) return;
    if (passed_s < 0.0 || passed_s > limits_.most_gap_s || !sample.tracked || jumped(newest, sample)) samples_.clear();
  }
  if (sample.tracked) samples_.push_back(sample);
  while (!samples_.empty() && samples_.front().clock_s < sample.clock_s - limits_.window_s) samples_.pop_front();
  Slope position;
  Slope rotation;
  for (const PoseSample& past : samples_) {
    const double time_s = past.clock_s - sample.clock_s;
    position.add(time_s, past.pose.position_m - sample.pose.position_m);
    rotation.add(time_s, rotation_vector(past.pose.rotation * glm::conjugate(sample.pose.rotation)));
  }
  velocity_m_s_ = position.per_s();
  turning_rad_s_ = rotation.per_s();
}

std::optional<Rigid> Motion::at(double time_s) const {
  if (samples_.empty()) return std::nullopt;
  const PoseSample& newest = samples_.back();
  const double ahead_s = std::clamp(time_s - newest.seen_s, 0.0, limits_.most_ahead_s);
  return Rigid{newest.pose.position_m + ahead_s * velocity_m_s_,
               glm::normalize(rotation_by(ahead_s * turning_rad_s_) * newest.pose.rotation)};
}

}  // namespace focalstage
