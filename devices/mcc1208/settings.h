#pragma once

#include <optional>
#include <string>

namespace focalstage {

/// How a USB-1208FS-Plus drives the lenses: channel 0 through the user's current amplifier, channel 1 the sync edge.
struct Mcc1208Settings {
  std::string serial;  ///< empty: the only one that is plugged in

  // The amplifier is the user's own: nothing is known of it until it was measured.
  double amperes_per_volt = 0.0;  ///< through both lenses; below 0 where it turns the sign. 0: not told, nothing starts
  int zero_code = 2048;           ///< of channel 0, at which no current flows
  double most_a = 0.25;           ///< either way; beyond 0.29 A (`mcc1208_hard_limit_a`) it is cut to that
  std::optional<int> enable_bit;  ///< of the DIO ports, 0..7 on A and 8..15 on B, that lets the amplifier work
  bool enable_high = true;        ///< the level that lets it
  double ramp_s = 0.04;           ///< to zero at a stop and to the first sample at a start; 0..0.06

  int samples = 400;               ///< of a period; 400 make 60 Hz exactly
  double most_off_ppm = 100.0;     ///< a period that can only be made further off is refused
  double most_scans_per_s = 25e3;  ///< of two channels; the maker names it for inputs, for outputs nobody does
  double sync_pulse_s = 1e-3;      ///< how long channel 1 stays high
  int queued_periods = 4;          ///< with the kernel, 3..32: how long the host may be busy

  double answer_s = 0.03;  ///< a request without an answer for so long has failed
  double watch_s = 0.1;    ///< between two looks at the status
  double silence_s = 0.3;  ///< without an answer, or with no bytes taken while it runs: lost
};

/// No setting goes beyond it: the lens driver of the same lens ends at 0.293 A.
inline constexpr double mcc1208_hard_limit_a = 0.29;

}  // namespace focalstage
