#include "core/optics/transfer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace focalstage {

double share_of_code(double code, int bits, double gamma, const std::vector<double>& transfer) {
  const double highest = (1 << bits) - 1;
  const double along = std::clamp(code, 0.0, highest) / highest;
  if (transfer.size() < 2) return std::pow(along, gamma);
  const double place = along * static_cast<double>(transfer.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), transfer.size() - 2);
  const double share = place - static_cast<double>(below);
  return transfer[below] + share * (transfer[below + 1] - transfer[below]);
}

}  // namespace focalstage
