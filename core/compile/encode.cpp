#include "core/compile/encode.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace focalstage {

Encoder::Encoder(int bits, double gamma) : plain_(gamma == 1.0), highest_(static_cast<float>((1 << bits) - 1)) {
  least_.fill(std::numeric_limits<float>::infinity());
  least_[0] = 0.0f;
  for (std::size_t code = 1; code <= static_cast<std::size_t>(highest_); ++code) {
    least_[code] = static_cast<float>(std::pow((static_cast<double>(code) - 0.5) / highest_, gamma));
  }
}

std::uint8_t Encoder::curved(float light) const {
  const auto above = std::upper_bound(least_.begin(), least_.end(), light);
  return static_cast<std::uint8_t>(above - least_.begin() - 1);
}

}  // namespace focalstage
