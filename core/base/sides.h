#pragma once

#include <array>
#include <cstddef>

namespace focalstage {

/// Left and right, in the order every file of ours stores them.
enum class Side { left = 0, right = 1 };
inline constexpr std::array<Side, 2> both_sides{Side::left, Side::right};

constexpr std::size_t index_of(Side side) { return static_cast<std::size_t>(side); }

/// One value per eye.
template <class T>
struct PerEye {
  T left{};
  T right{};

  bool operator==(const PerEye&) const = default;
  T& operator[](Side side) { return side == Side::left ? left : right; }
  const T& operator[](Side side) const { return side == Side::left ? left : right; }
};

}  // namespace focalstage
