#include "core/reference/chances.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace focalstage {
namespace {

constexpr std::size_t dimensions = Chances{}.size();

double halton(std::uint32_t index, std::uint32_t base) {
  double sum = 0.0, part = 1.0;
  for (; index > 0; index /= base) {
    part /= base;
    sum += part * (index % base);
  }
  return sum;
}

std::uint64_t mixed(std::uint64_t x) {  // splitmix64's finalizer
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

}  // namespace

Chances chances_of(int pixel, int ray) {
  constexpr std::array<std::uint32_t, dimensions> bases{2, 3, 5, 7, 11, 13, 17, 19, 23};
  Chances chances;
  for (std::size_t i = 0; i < dimensions; ++i) {
    const std::uint64_t turn = mixed(static_cast<std::uint64_t>(pixel) * dimensions + i);
    const double sum =
        halton(static_cast<std::uint32_t>(ray + 1), bases[i]) + static_cast<double>(turn >> 11) * 0x1p-53;
    chances[i] = sum - std::floor(sum);
  }
  return chances;
}

}  // namespace focalstage
