#include "editor/cli/self_test_output.h"

#include <doctest/doctest.h>

using namespace focalstage;

TEST_CASE("what a rig measured is a table with spreads, and the same as JSON") {
  RigMeasurement measurement{60.0, 1'700'000'000, {0.2104, 0.0052}, {0.011, 0.001}, {}};
  measurement.eye.left = {
      {0.18, 0.004}, {2.41, 0.02}, {-0.004, 0.01}, {{0, {36.1, 0.3}, {}}, {1, {34.5, 0.2}, {-20.1, 0.15}}}};
  measurement.eye.right = {{0.19, 0.005}, {2.4, 0.03}, {0.0, 0.01}, {{0, {39.0, 0.3}, {}}}};
  const std::string table = measurement_table(measurement);
  CHECK(table.find("0.2104  ±  0.0052  ms\n") != std::string::npos);
  CHECK(table.find(" -20.10  ±    0.15  degrees\n") != std::string::npos);
  CHECK(table.find("harmonic 0, phase") == std::string::npos);
  CHECK(table.find("stray") == std::string::npos);  // the sweep of one lens was not measured
  const Value value = value_of(measurement);
  CHECK(*value.find("latency_ms")->find("spread") == Value(0.0052));
  const Value second = (*value.find("left")->find("lens")->array())[1];
  CHECK(*second.find("phase_deg")->find("value") == Value(-20.1));
  CHECK(value.find("right")->find("lens")->array()->size() == 1);
  measurement.eye.right.lens.push_back({1, {34.5, 0.2}, {-18.1, 0.15}});  // 2 degrees apart: tan of 1
  CHECK(measurement_table(measurement).find("\nOn one channel, each lens would stray by 0.0175 D per dioptre") !=
        std::string::npos);
}
