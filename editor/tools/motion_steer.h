#pragma once

#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "editor/tools/handle_frame.h"
#include "editor/tools/room_camera.h"

namespace focalstage {

/// How a hand's motion is taken.
struct SteerSettings {
  double sensitivity = 1.0;  ///< at 1, full deflection goes one distance a second, and turns 120 degrees
  bool invert_push = false;
  bool invert_turn = false;
  bool fly = false;  ///< the hand is the camera; else it holds the room

  bool operator==(const SteerSettings&) const = default;
};
inline constexpr double least_sensitivity = 0.1;
inline constexpr double most_sensitivity = 10.0;

/// How far a hand pushes and turns a six-axis input, -1..1: +X right, +Y up, +Z towards the user.
struct HandMotion {
  glm::dvec3 push{0.0};
  glm::dvec3 turn{0.0};

  bool rests() const { return push == glm::dvec3(0.0) && turn == glm::dvec3(0.0); }
};

/// The camera after the hand held so for `delta_s`. Holding the room: it goes with the hand, turns about the target and
/// comes nearer by shares of its distance. Flying: the camera goes and looks where the hand does. Either way the speed
/// grows with the distance, small deflections are slow, and the horizon stays level.
RoomCamera steered(const RoomCamera& camera, const HandMotion& motion, const SteerSettings& settings, double delta_s);

/// Things in the hand, pushed along the axes of the view and turned about the middle of them; those that do not turn
/// keep their direction. `distance_m`: of their middle from the eye; the speed grows with it.
std::vector<HandleThing> carried(std::vector<HandleThing> things, const glm::dquat& world_from_view, double distance_m,
                                 const HandMotion& motion, const SteerSettings& settings, double delta_s);

}  // namespace focalstage
