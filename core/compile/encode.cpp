#include "core/compile/encode.h"

#include <algorithm>
#include <limits>

#include "core/optics/transfer.h"

namespace focalstage {

Encoder::Encoder(int bits, double gamma, const std::vector<double>& transfer)
    : plain_(gamma == 1.0 && transfer.empty()), highest_(static_cast<float>((1 << bits) - 1)) {
  least_.fill(std::numeric_limits<float>::infinity());
  least_[0] = 0.0f;
  for (std::size_t code = 1; code <= static_cast<std::size_t>(highest_); ++code) {
    least_[code] = static_cast<float>(share_of_code(static_cast<double>(code) - 0.5, bits, gamma, transfer));
  }
}

std::uint8_t Encoder::curved(float light) const {
  const auto above = std::upper_bound(least_.begin(), least_.end(), light);
  return static_cast<std::uint8_t>(above - least_.begin() - 1);
}

}  // namespace focalstage
