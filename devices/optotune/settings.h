#pragma once

#include <string>

#include "devices/serial/serial_ports.h"

namespace focalstage {

/// A Lens Driver 4 or 4i on its serial port, and what differs between units.
struct OptotuneSettings {
  std::string serial;          ///< of its USB; empty: the only one that is plugged in
  SerialSearch search;         ///< `paths`: ports that are no USB, taken for lens drivers
  double most_a = 0.25;        ///< either way; beyond 0.29 A (`optotune_hard_limit_a`) it is cut to that
  bool wide_limits = false;    ///< CwUA and CwLA with four bytes of data: some firmware is said to want them
  double warm_celsius = 45.0;  ///< from here on the lens is told to be warm
  double hot_celsius = 50.0;   ///< and here it is stopped, until it is 1 C below warm
  double answer_s = 0.1;       ///< without an answer for so long a request has failed
  double refusal_s = 0.01;     ///< so long a refusal of what is silent where it succeeds is waited for
  double watch_s = 0.15;       ///< between two looks whether it is there
  double temperature_s = 1.0;  ///< between two looks at the temperature
  double ramp_step_s = 0.015;  ///< a stop halves the current five times with so much between
};

/// No setting goes beyond it: the driver's own top is 0.29284 A.
inline constexpr double optotune_hard_limit_a = 0.29;

}  // namespace focalstage
