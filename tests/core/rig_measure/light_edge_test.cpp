#include "core/rig_measure/light_edge.h"

#include <doctest/doctest.h>

#include "tests/core/rig_measure/bench.h"

using namespace focalstage;

namespace {

constexpr double trigger_s = 0.0055;
constexpr double exposure_s = 0.0005;

/// Light of one exposure with a straight rise and fall of `rise_s` each, the middle of the rise `latency_s` late.
double exposure(double time_s, double latency_s, double rise_s) {
  const double up = (time_s - trigger_s - latency_s) / rise_s + 0.5;
  const double down = (time_s - trigger_s - latency_s - exposure_s) / rise_s + 0.5;
  return 0.5 * (std::clamp(up, 0.0, 1.0) - std::clamp(down, 0.0, 1.0));
}

Result<LightEdge> measured(const bench::Sensor& sensor, double latency_s, double rise_s, int traces = 24) {
  const auto dark = dark_light(bench::record(
      sensor, [](double) { return 0.0; }, 0.005, 80, traces));
  REQUIRE(dark);
  bench::Sensor again = sensor;
  ++again.seed;
  const auto lit = bench::record(
      again, [&](double t) { return exposure(t, latency_s, rise_s); }, 0.005, 80, traces);
  return light_edge(lit, *dark, trigger_s, exposure_s);
}

TEST_CASE("a latency is found much finer than the sensor's step") {
  bench::Sensor sensor;
  for (const double latency_s : {0.0001, 0.0001531, 0.00021}) {
    for (const int bits : {8, 10, 12}) {
      sensor.bits = bits;
      ++sensor.seed;
      const auto edge = measured(sensor, latency_s, 2e-6);
      REQUIRE(edge);
      CHECK(edge->latency_ms.value == doctest::Approx(1e3 * latency_s).epsilon(0.05));
      CHECK(std::abs(edge->latency_ms.value - 1e3 * latency_s) < 4.0 * edge->latency_ms.spread);
      CHECK(edge->latency_ms.spread < 0.008);
    }
  }
}

TEST_CASE("a slow rise is measured, and its half goes into the spread") {
  const auto edge = measured({}, 0.00015, 100e-6);
  REQUIRE(edge);
  CHECK(edge->latency_ms.value == doctest::Approx(0.15).epsilon(0.05));
  CHECK(edge->rise_ms.value == doctest::Approx(0.08).epsilon(0.15));
  CHECK(edge->latency_ms.spread > 0.03);
}

TEST_CASE("no exposure, light before its trigger, and too much light are refused") {
  CHECK(measured({}, 0.02, 2e-6).fault().code == "measure.latency");
  CHECK(measured({}, -0.0003, 2e-6).fault().code == "measure.latency");
  bench::Sensor bright;
  bright.ambient = 0.6;
  CHECK(measured(bright, 0.00015, 2e-6).fault().code == "measure.saturated");
}

}  // namespace
