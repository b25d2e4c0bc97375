#include "devices/planes/plane_order.h"

#include <array>
#include <cassert>
#include <cstddef>

namespace focalstage {

namespace {

/// Each depth's patterns begin at `first` + number * `step`.
struct DepthPlanes {
  int patterns;
  int first;
  int step;
};

constexpr std::array<DepthPlanes, 8> depths{
    {{24, 0, 1}, {12, 0, 2}, {8, 0, 3}, {6, 0, 4}, {4, 1, 6}, {4, 0, 6}, {3, 1, 8}, {3, 0, 8}}};

const DepthPlanes& depth_of(int bits) {
  assert(bits >= 1 && bits <= 8);
  return depths[static_cast<std::size_t>(bits - 1)];
}

}  // namespace

int most_patterns(int bits) { return depth_of(bits).patterns; }

PlaneSpan planes_of(int bits, int number) {
  const DepthPlanes& depth = depth_of(bits);
  assert(number >= 0 && number < depth.patterns);
  return {depth.first + number * depth.step, bits};
}

}  // namespace focalstage
