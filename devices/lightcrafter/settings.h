#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "devices/lightcrafter/plan.h"

namespace focalstage {

/// What may differ between units, or is not certain before a unit was seen (README.md says which is which).
struct LightCrafterSettings {
  std::string serial;   ///< of the unit; empty: the only one, or the first
  std::string address;  ///< "/dev/hidraw3"; empty: wherever it is

  double brightness = 0.1;       ///< of the LEDs, 0..1 of their full current
  double most_brightness = 0.5;  ///< what goes beyond is cut
  lightcrafter::PlanRules plan;

  double answer_s = 0.5;             ///< how long an answer may take
  double dark_answer_s = 0.06;       ///< the same where light must go off
  double validate_s = 2.0;           ///< how long the validation of a table may take
  double settle_s = 0.1;             ///< from "start" to a sequencer that says it runs; then "start" is sent once more
  double poll_s = 0.25;              ///< between looks at the status; two without an answer are a loss
  bool warnings_are_faults = false;  ///< of the validation
  std::optional<std::uint8_t> input_source;  ///< raw byte for 1A 00; none: left as the board's firmware set it
  bool check_signal = true;                  ///< refuses to arm unless 912 x 1140 pixels arrive
  double light_after_vblank_s = 0.0;         ///< from the time of a display's vblank to the light of the first pattern
};

}  // namespace focalstage
