#pragma once

#include "core/scene/codec.h"

namespace focalstage {

// Bounds that no rig and no room reaches: they keep nonsense from becoming infinities further down.
inline constexpr Rule anywhere_m{.low = -1e6, .high = 1e6};
inline constexpr Rule length_m{.low = 0.0, .high = 1e6, .above_low = true};
inline constexpr Rule length_mm{.low = 0.0, .high = 1e3, .above_low = true};
inline constexpr Rule duration_ms{.low = 0.0, .high = 1e5};
inline constexpr Rule frequency_hz{.low = 0.0, .high = 1e6, .above_low = true};
inline constexpr Rule power_d{.low = -1e3, .high = 1e3};
inline constexpr Rule length_px{.low = 0.0, .high = 1e6, .above_low = true};
inline constexpr Rule fraction{.low = 0.0, .high = 1.0};
inline constexpr Rule brightness{.low = 0.0, .high = 1e6};
inline constexpr Rule time_s{.low = -1e6, .high = 1e6};
inline constexpr Rule a_name{.least = 1};

}  // namespace focalstage
