#include "devices/planes/blue_noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace focalstage {

namespace {

constexpr std::size_t side = BlueNoise::size;
constexpr std::size_t area = side * side;

/// How crowded each cell is by the ones around it: a Gaussian of 1.9 cells, which wraps around. Whole numbers: what is
/// added and taken away again leaves nothing behind.
class Crowding {
 public:
  Crowding() : kernel_(area), crowd_(area, 0) {
    for (std::size_t y = 0; y < side; ++y) {
      for (std::size_t x = 0; x < side; ++x) {
        const auto dx = static_cast<double>(std::min(x, side - x));
        const auto dy = static_cast<double>(std::min(y, side - y));
        kernel_[y * side + x] = std::lround(std::ldexp(std::exp(-(dx * dx + dy * dy) / (2.0 * 1.9 * 1.9)), 20));
      }
    }
  }

  void add(std::size_t cell, std::int64_t sign) {
    const std::size_t x0 = cell % side;
    const std::size_t y0 = cell / side;
    for (std::size_t y = 0; y < side; ++y) {
      const std::int64_t* from = &kernel_[((y + side - y0) % side) * side];
      std::int64_t* row = &crowd_[y * side];
      for (std::size_t x = 0; x < side; ++x) row[x] += sign * from[(x + side - x0) % side];
    }
  }

  /// The most crowded of the cells that are `set`, or the least crowded of those that are not; the first where several.
  std::size_t tightest(const std::vector<char>& cells) const {
    return best(cells, [](std::int64_t crowd, char set) { return set != 0 ? crowd : lowest; });
  }
  std::size_t widest_void(const std::vector<char>& cells) const {
    return best(cells, [](std::int64_t crowd, char set) { return set != 0 ? lowest : -crowd; });
  }

 private:
  static constexpr std::int64_t lowest = -(std::int64_t{1} << 60);

  template <class Merit>
  std::size_t best(const std::vector<char>& cells, Merit merit) const {
    std::size_t at = 0;
    std::int64_t most = lowest;
    for (std::size_t i = 0; i < area; ++i) {
      const std::int64_t here = merit(crowd_[i], cells[i]);
      if (here > most) {
        most = here;
        at = i;
      }
    }
    return at;
  }

  std::vector<std::int64_t> kernel_;
  std::vector<std::int64_t> crowd_;
};

std::uint64_t next_random(std::uint64_t& state) {  // splitmix64
  std::uint64_t z = (state += 0x9E3779B97F4A7C15U);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31);
}

/// A tenth of the cells, moved from clusters to voids until that changes nothing (or often enough).
std::vector<char> even_start(std::uint64_t seed, Crowding& crowding) {
  std::vector<char> cells(area, 0);
  for (std::size_t left = area / 10; left > 0;) {
    const std::size_t cell = next_random(seed) % area;
    if (cells[cell] != 0) continue;
    cells[cell] = 1;
    crowding.add(cell, 1);
    --left;
  }
  for (std::size_t moves = 0; moves < area; ++moves) {
    const std::size_t from = crowding.tightest(cells);
    cells[from] = 0;
    crowding.add(from, -1);
    const std::size_t to = crowding.widest_void(cells);
    cells[to] = 1;
    crowding.add(to, 1);
    if (to == from) break;
  }
  return cells;
}

}  // namespace

BlueNoise make_blue_noise(std::uint64_t seed) {
  Crowding crowding;
  const std::vector<char> start = even_start(seed, crowding);
  std::vector<std::size_t> rank(area, 0);
  const auto begun = static_cast<std::size_t>(std::ranges::count(start, char{1}));

  // Down from the start: the tightest goes first. Up from it: the widest void is filled first.
  Crowding down = crowding;
  std::vector<char> cells = start;
  for (std::size_t left = begun; left-- > 0;) {
    const std::size_t cell = down.tightest(cells);
    cells[cell] = 0;
    down.add(cell, -1);
    rank[cell] = left;
  }
  cells = start;
  for (std::size_t next = begun; next < area; ++next) {
    const std::size_t cell = crowding.widest_void(cells);
    cells[cell] = 1;
    crowding.add(cell, 1);
    rank[cell] = next;
  }

  BlueNoise noise;
  for (std::size_t i = 0; i < area; ++i) noise.thresholds[i] = static_cast<std::uint8_t>(rank[i] * 256 / area);
  return noise;
}

const BlueNoise& blue_noise() {
  static const BlueNoise noise = make_blue_noise(1);
  return noise;
}

}  // namespace focalstage
