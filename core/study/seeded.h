#pragma once

#include <cstdint>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

namespace focalstage {

/// Chance that is the same everywhere: the standard fixes mt19937_64 to the bit, but not its distributions, so those
/// are made here.
class Seeded {
 public:
  explicit Seeded(std::uint64_t seed) : engine_(seed) {}

  /// A stream of its own for each purpose, so that drawing more of one thing changes no other.
  Seeded(std::uint64_t seed, std::string_view purpose);

  std::uint64_t below(std::uint64_t limit);  ///< 0 to limit - 1, each as likely; `limit` above 0
  double share();                            ///< 0 up to but not 1
  double gaussian();                         ///< mean 0, standard deviation 1

  template <class T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[below(i)]);
  }

 private:
  std::mt19937_64 engine_;
};

/// 0 to count - 1 in an order of chance.
std::vector<int> shuffled_indices(int count, Seeded& chance);

}  // namespace focalstage
