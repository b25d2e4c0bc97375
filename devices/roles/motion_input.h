#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "devices/roles/device.h"

namespace focalstage {

/// How far a six-axis input is pushed and turned now: -1..1 of its full deflection, right-handed, +X right, +Y up, +Z
/// towards the user; zero within its dead zone and when it fell silent.
struct Deflection {
  glm::dvec3 push{0.0};
  glm::dvec3 turn{0.0};       ///< about the axes
  std::uint32_t buttons = 0;  ///< bit 0 is the first

  bool operator==(const Deflection&) const = default;
};

/// A device that a hand pushes and turns (a SpaceMouse). Runs from `open` on.
class MotionInput : public Device {
 public:
  virtual Deflection deflection() const = 0;
};

}  // namespace focalstage
