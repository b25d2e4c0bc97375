#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include <glm/gtc/type_precision.hpp>
#include <glm/vec3.hpp>

namespace focalstage {

/// Of positions, as they compare (0 and -0 are equal), and of the cells of a grid.
struct PositionHash {
  std::size_t operator()(const glm::dvec3& position) const {
    return mixed([&](int i) { return std::bit_cast<std::uint64_t>(position[i] + 0.0); });  // -0 + 0.0 is 0
  }
  std::size_t operator()(const glm::i64vec3& cell) const {
    return mixed([&](int i) { return static_cast<std::uint64_t>(cell[i]); });
  }

 private:
  template <class Word>
  static std::size_t mixed(const Word& word) {
    std::uint64_t hash = 0;
    for (int i = 0; i < 3; ++i) {
      hash = (hash ^ word(i)) * 0x9E3779B97F4A7C15U;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

}  // namespace focalstage
