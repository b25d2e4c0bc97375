#include "core/schedule/shutter.h"

#include <doctest/doctest.h>

using namespace focalstage;

namespace {

constexpr double period_s = 1.0 / 60.0;

Glasses shutters(double open_ms, double close_ms) {
  Glasses glasses;
  glasses.shutter_open_ms = open_ms;
  glasses.shutter_close_ms = close_ms;
  return glasses;
}

}  // namespace

TEST_CASE("slow to open: both are told at the start of a 3 ms window around each extremum") {
  const ShutterPlan plan = plan_shutters(shutters(3.0, 0.1), period_s, period_s / 2.0);
  CHECK(plan.told.left.open_s == doctest::Approx(period_s - 0.0015));
  CHECK(plan.told.left.close_s == doctest::Approx(period_s / 2.0 - 0.0015));
  CHECK(plan.told.right.open_s == doctest::Approx(period_s / 2.0 - 0.0015));
  CHECK(plan.told.right.close_s == doctest::Approx(period_s - 0.0015));
  CHECK(plan.clear.left.from_s == doctest::Approx(0.0015));
  CHECK(plan.clear.left.to_s == doctest::Approx(period_s / 2.0 - 0.0015));
  CHECK(plan.clear.right.from_s == doctest::Approx(period_s / 2.0 + 0.0015));
  CHECK(plan.clear.right.to_s == doctest::Approx(period_s - 0.0015));
}

TEST_CASE("slow to close: the other opens as late as the window allows") {
  const ShutterPlan plan = plan_shutters(shutters(0.5, 2.0), period_s, period_s / 2.0);
  CHECK(plan.told.right.close_s == doctest::Approx(period_s - 0.001));
  CHECK(plan.told.left.open_s == doctest::Approx(0.0005));  // done at +1 ms, as the window ends
  CHECK(plan.told.left.close_s == doctest::Approx(period_s / 2.0 - 0.001));
  CHECK(plan.told.right.open_s == doctest::Approx(period_s / 2.0 + 0.0005));
}

TEST_CASE("no change leaves its window, one opens only as the other is closing") {
  for (const double open_ms : {0.0, 0.1, 1.0, 3.0}) {
    for (const double close_ms : {0.0, 0.1, 2.0, 4.0}) {
      const double window_s = std::max(open_ms, close_ms) / 1000.0;
      const double handover_s = 0.4 * period_s;
      const ShutterPlan plan = plan_shutters(shutters(open_ms, close_ms), period_s, handover_s);
      CHECK(plan.told.left.close_s >= handover_s - window_s / 2.0 - 1e-12);
      CHECK(plan.told.left.close_s + close_ms / 1000.0 <= handover_s + window_s / 2.0 + 1e-12);
      CHECK(plan.told.right.open_s + open_ms / 1000.0 == doctest::Approx(handover_s + window_s / 2.0));
      CHECK(plan.told.right.open_s >= plan.told.left.close_s - 1e-12);
      for (const Side eye : both_sides) {
        CHECK(plan.told[eye].open_s >= 0.0);
        CHECK(plan.told[eye].open_s < period_s);
        CHECK(plan.told[eye].close_s >= 0.0);
        CHECK(plan.told[eye].close_s < period_s);
      }
    }
  }
}

TEST_CASE("shutters slower than half a period leave no time at all") {
  const ShutterPlan plan = plan_shutters(shutters(9.0, 0.1), period_s, period_s / 2.0);
  CHECK(plan.clear.left.length_s() == 0.0);
  CHECK(plan.clear.right.length_s() == 0.0);
}
