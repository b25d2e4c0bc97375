#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "devices/lightcrafter/packets.h"
#include "devices/planes/frame_packer.h"
#include "devices/roles/projector.h"

namespace focalstage::lightcrafter {

/// How the time between two exposures is kept dark.
enum class Gap {
  spare_time,  ///< the entry's period is longer than its exposure: needs 230 us
  dark_entry,  ///< an entry of its own without LEDs: needs 235 us
};

struct PlanRules {
  std::optional<int> shown_bits;  ///< of the patterns; none: as many as the pictures have
  Gap gap = Gap::spare_time;
  bool black_after = true;  ///< asks for black mirrors wherever darkness follows
  std::uint8_t leds = 7;    ///< for gray pictures
  double period_tolerance = 0.002;
};

struct PlanEntry {
  LutEntry lut;
  std::uint32_t exposure_us = 0;
  std::uint32_t period_us = 0;

  bool operator==(const PlanEntry&) const = default;
};

/// A table for trigger mode 4: the first entry starts with a vsync, the others follow by the device's own time.
struct PatternPlan {
  std::vector<PlanEntry> entries;
  double lead_s = 0.0;  ///< from the period's start to the vsync: the first exposure begins with it
  std::uint32_t total_us = 0;
  PackPlan pack;
};

/// Turns exposures of a period into a table. `interval_s`: between vsyncs. "projector.unable" says which limit they are
/// beyond: the display's period, the least exposure at that depth, the planes of a frame, the time in the dark between
/// two exposures, or the time before the next vsync.
Result<PatternPlan> plan_patterns(const Exposures& exposures, double interval_s, const PlanRules& rules = {});

}  // namespace focalstage::lightcrafter
