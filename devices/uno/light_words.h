#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace focalstage::uno {

/// What a board with the firmware of devices/firmware says of light. Bytes only.

/// Between two samples, by the board's own clock.
inline constexpr double light_step_s = 26e-6;

/// What SEEN says.
struct LightLine {
  enum class State { none, waiting, whole, lost };
  State state = State::none;
  double after_s = 0.0;  ///< from the sync edge to the first sample, by the board's own clock
  std::size_t samples = 0;
};

std::optional<LightLine> decode_light(std::string_view words);

/// What DATA says: shares of the range, 1023 codes. Nothing where it is no row of three hex digits each.
std::optional<std::vector<double>> decode_samples(std::string_view words);

}  // namespace focalstage::uno
