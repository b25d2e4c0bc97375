#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace focalstage {

/// Linear light to projector codes: round((2^bits - 1) min(1, L)^(1/gamma)), halves up; by a measured `transfer` the
/// code nearest to the place where it gives that light.
class Encoder {
 public:
  Encoder(int bits, double gamma, const std::vector<double>& transfer = {});

  std::uint8_t code(float light) const {
    if (!(light > 0.0f)) return 0;
    if (plain_) return static_cast<std::uint8_t>((light < 1.0f ? light : 1.0f) * highest_ + 0.5f);
    return curved(light);
  }

 private:
  std::uint8_t curved(float light) const;

  bool plain_;
  float highest_;
  std::array<float, 257> least_{};  ///< the least light that has each code; with a curve
};

}  // namespace focalstage
