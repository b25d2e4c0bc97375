#pragma once

#include <array>

namespace focalstage {

/// What a rig may come to doubt.
enum class Doubt {
  late_frame,
  missed_blackout,
  sync_edge,
  hung_firmware,
  live_client,
  tracker,
  serial_device,
  projector_status,
};

/// How long a doubt may stay unnoticed: so many seconds, and so many sweeps on top. Darkness follows within one sweep
/// more (design section 8).
struct Detection {
  Doubt doubt;
  double seconds;
  double sweeps;
};

inline constexpr std::array<Detection, 8> detections{{
    {Doubt::late_frame, 0.0, 1.0},
    {Doubt::missed_blackout, 0.0, 1.0},
    {Doubt::sync_edge, 0.025, 0.0},
    {Doubt::hung_firmware, 0.060, 0.0},
    {Doubt::live_client, 0.250, 0.0},
    {Doubt::tracker, 0.100, 0.0},
    {Doubt::serial_device, 0.500, 0.0},
    {Doubt::projector_status, 1.0, 0.0},
}};

constexpr double detection_s(Doubt doubt, double period_s) {
  for (const Detection& detection : detections) {
    if (detection.doubt == doubt) return detection.seconds + detection.sweeps * period_s;
  }
  return 0.0;
}

/// By when the rig is dark.
constexpr double dark_within_s(Doubt doubt, double period_s) { return detection_s(doubt, period_s) + period_s; }

}  // namespace focalstage
