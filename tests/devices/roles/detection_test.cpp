#include "devices/roles/detection.h"

#include <doctest/doctest.h>

namespace focalstage {
namespace {

TEST_CASE("how long each doubt may stay unnoticed is what the design says") {
  constexpr double period_s = 1.0 / 60.0;
  static_assert(detection_s(Doubt::late_frame, period_s) == period_s);
  static_assert(detection_s(Doubt::missed_blackout, period_s) == period_s);
  static_assert(detection_s(Doubt::sync_edge, period_s) == 0.025);
  static_assert(detection_s(Doubt::hung_firmware, period_s) == 0.060);
  static_assert(detection_s(Doubt::live_client, period_s) == 0.250);
  static_assert(detection_s(Doubt::tracker, period_s) == 0.100);
  static_assert(detection_s(Doubt::serial_device, period_s) == 0.500);
  static_assert(detection_s(Doubt::projector_status, period_s) == 1.0);
  CHECK(dark_within_s(Doubt::tracker, period_s) == doctest::Approx(0.1 + period_s));
}

}  // namespace
}  // namespace focalstage
