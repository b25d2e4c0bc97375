#include "devices/service/metrics.h"

#include <limits>

#include <doctest/doctest.h>

namespace focalstage {
namespace {

RuntimeFigures figures() {
  RuntimeFigures figures;
  figures.state.state = "playing";
  figures.state.sweeps = 5'184'000;
  figures.state.missed_exposures = 3;
  figures.state.late_sweeps = 2;
  figures.state.holder = "studio";
  figures.state.lateness = {{50.0, 7}, {100.0, 0}, {1000.0, 2}, {std::numeric_limits<double>::infinity(), 1}};
  figures.state.temperatures = {{"left lens", 31.5}, {"a \"part\"\\\n", 20.0}};
  figures.push_bytes = 4096;
  figures.watchers = 2;
  figures.connections = 5;
  figures.turned_away = 6;
  figures.faults = {{"rig.missed-light", 1}, {"rig.request", 4}};
  return figures;
}

bool has(const std::string& page, const std::string& line) {
  return ("\n" + page).find("\n" + line + "\n") != std::string::npos;
}

TEST_CASE("every figure has its line in Prometheus' text form") {
  const std::string page = metrics_text(figures());
  CHECK(has(page, "# TYPE focalstage_state gauge"));
  CHECK(has(page, "focalstage_state{state=\"playing\"} 1"));
  CHECK(has(page, "focalstage_state{state=\"dark\"} 0"));
  CHECK(has(page, "focalstage_fault_latched 0"));
  CHECK(has(page, "focalstage_held 1"));
  CHECK(has(page, "# TYPE focalstage_sweeps_total counter"));
  CHECK(has(page, "focalstage_sweeps_total 5184000"));
  CHECK(has(page, "focalstage_missed_exposures_total 3"));
  CHECK(has(page, "focalstage_late_sweeps_total 2"));
  CHECK(has(page, "focalstage_push_bytes_total 4096"));
  CHECK(has(page, "focalstage_watchers 2"));
  CHECK(has(page, "focalstage_connections 5"));
  CHECK(has(page, "focalstage_connections_turned_away_total 6"));
  CHECK(has(page, "focalstage_faults_total{code=\"rig.request\"} 4"));
  CHECK(has(page, "focalstage_temperature_celsius{part=\"left lens\"} 31.5"));
  CHECK(has(page, "focalstage_temperature_celsius{part=\"a \\\"part\\\"\\\\\\n\"} 20"));
}

TEST_CASE("the lateness is a histogram: its buckets add up, the last has them all") {
  const std::string page = metrics_text(figures());
  CHECK(has(page, "# TYPE focalstage_sweep_lateness_seconds histogram"));
  CHECK(has(page, "focalstage_sweep_lateness_seconds_bucket{le=\"5e-05\"} 7"));
  CHECK(has(page, "focalstage_sweep_lateness_seconds_bucket{le=\"1e-04\"} 7"));
  CHECK(has(page, "focalstage_sweep_lateness_seconds_bucket{le=\"0.001\"} 9"));
  CHECK(has(page, "focalstage_sweep_lateness_seconds_bucket{le=\"+Inf\"} 10"));
  CHECK(has(page, "focalstage_sweep_lateness_seconds_count 10"));
}

}  // namespace
}  // namespace focalstage
