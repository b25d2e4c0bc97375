#include "core/study/seeded.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace focalstage {
namespace {

/// FNV-1a: spreads seed and purpose over 64 bits.
std::uint64_t mixed(std::uint64_t seed, std::string_view purpose) {
  std::uint64_t hash = 14695981039346656037ull;
  const auto add = [&](std::uint8_t byte) { hash = (hash ^ byte) * 1099511628211ull; };
  for (int shift = 0; shift < 64; shift += 8) add(static_cast<std::uint8_t>(seed >> shift));
  for (const char c : purpose) add(static_cast<std::uint8_t>(c));
  return hash;
}

}  // namespace

Seeded::Seeded(std::uint64_t seed, std::string_view purpose) : engine_(mixed(seed, purpose)) {}

std::uint64_t Seeded::below(std::uint64_t limit) {
  // Numbers of the last, incomplete round would favour small remainders.
  const std::uint64_t rest = (std::numeric_limits<std::uint64_t>::max() % limit + 1) % limit;
  std::uint64_t drawn = engine_();
  while (drawn > std::numeric_limits<std::uint64_t>::max() - rest) drawn = engine_();
  return drawn % limit;
}

double Seeded::share() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

/// Box and Muller, 1958.
double Seeded::gaussian() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - share()));
  return radius * std::cos(2.0 * std::numbers::pi * share());
}

std::vector<int> shuffled_indices(int count, Seeded& chance) {
  std::vector<int> indices(static_cast<std::size_t>(count));
  std::iota(indices.begin(), indices.end(), 0);
  chance.shuffle(indices);
  return indices;
}

}  // namespace focalstage
