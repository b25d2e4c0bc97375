#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include <glm/vec3.hpp>

namespace focalstage::support {

/// Seeded chance whose draws are the same with every standard library.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : engine_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  int whole(int low, int high) {  ///< both ends included
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool one_in(int n) { return engine_() % static_cast<std::uint64_t>(n) == 0; }
  std::uint64_t seed() { return engine_(); }

  glm::dvec3 within(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
  glm::dvec3 direction() {  ///< evenly over the sphere
    const double z = between(-1.0, 1.0), angle = between(0.0, 2.0 * std::numbers::pi), r = std::sqrt(1.0 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace focalstage::support
