#include "editor/tools/motion_steer.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace focalstage {
namespace {

constexpr double turn_deg_per_s = 120.0;
constexpr double nearest_m = 0.02;
constexpr double farthest_m = 500.0;
const glm::dvec2 any_size_px{100.0, 100.0};  // directions do not depend on it

/// Fine where the hand is light.
double eased(double share) { return share * std::abs(share); }

struct Rates {
  glm::dvec3 push{0.0};      ///< distances per second
  glm::dvec3 turn_deg{0.0};  ///< per second
};

Rates rates_of(const HandMotion& motion, const SteerSettings& settings) {
  const double push = settings.invert_push ? -settings.sensitivity : settings.sensitivity;
  const double turn = settings.invert_turn ? -settings.sensitivity : settings.sensitivity;
  Rates rates;
  for (int i = 0; i < 3; ++i) {
    rates.push[i] = push * eased(motion.push[i]);
    rates.turn_deg[i] = turn * turn_deg_per_s * eased(motion.turn[i]);
  }
  return rates;
}

glm::dquat rotation_of(const RoomCamera& camera) { return view_of(camera, any_size_px).world_from_camera.rotation; }

RoomCamera turned(RoomCamera camera, double right_deg, double down_deg) {
  camera.azimuth_deg = std::remainder(camera.azimuth_deg + right_deg, 360.0);
  camera.elevation_deg = std::clamp(camera.elevation_deg + down_deg, -90.0, 90.0);
  return camera;
}

RoomCamera with_room_held(const RoomCamera& camera, const Rates& rates, double delta_s) {
  RoomCamera moved = camera;
  const glm::dvec3 across(rates.push.x, rates.push.y, 0.0);
  moved.target_m -= rotation_of(camera) * (delta_s * camera.distance_m * across);
  moved.distance_m = std::clamp(camera.distance_m * std::exp(-delta_s * rates.push.z), nearest_m, farthest_m);
  return turned(moved, delta_s * rates.turn_deg.y, delta_s * rates.turn_deg.x);
}

RoomCamera flown(const RoomCamera& camera, const Rates& rates, double delta_s) {
  const glm::dvec3 back(0.0, 0.0, camera.distance_m);
  const glm::dvec3 eye_m = camera.target_m + rotation_of(camera) * (back + delta_s * camera.distance_m * rates.push);
  RoomCamera moved = turned(camera, -delta_s * rates.turn_deg.y, -delta_s * rates.turn_deg.x);
  moved.target_m = eye_m - rotation_of(moved) * back;
  return moved;
}

}  // namespace

RoomCamera steered(const RoomCamera& camera, const HandMotion& motion, const SteerSettings& settings, double delta_s) {
  if (motion.rests() || !(delta_s > 0.0)) return camera;
  const Rates rates = rates_of(motion, settings);
  return settings.fly ? flown(camera, rates, delta_s) : with_room_held(camera, rates, delta_s);
}

std::vector<HandleThing> carried(std::vector<HandleThing> things, const glm::dquat& world_from_view, double distance_m,
                                 const HandMotion& motion, const SteerSettings& settings, double delta_s) {
  if (things.empty() || motion.rests() || !(delta_s > 0.0)) return things;
  const Rates rates = rates_of(motion, settings);
  const glm::dvec3 shift_m = world_from_view * (delta_s * std::max(distance_m, nearest_m) * rates.push);
  const glm::dvec3 turn_rad = glm::radians(delta_s * rates.turn_deg);
  const double angle_rad = glm::length(turn_rad);
  glm::dquat turn(1.0, 0.0, 0.0, 0.0);
  if (angle_rad > 0.0) turn = glm::angleAxis(angle_rad, glm::normalize(world_from_view * turn_rad));
  glm::dvec3 middle_m(0.0);
  for (const HandleThing& thing : things) middle_m += thing.pose.position_m / static_cast<double>(things.size());
  for (HandleThing& thing : things) {
    thing.pose.position_m = middle_m + turn * (thing.pose.position_m - middle_m) + shift_m;
    if (thing.turns) thing.pose.rotation = glm::normalize(turn * thing.pose.rotation);
  }
  return things;
}

}  // namespace focalstage
