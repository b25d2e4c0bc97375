#include "io/rig_config/measurement_file.h"

#include <fstream>

#include <doctest/doctest.h>

#include "tests/support/temporary_folder.h"

using namespace focalstage;

namespace {

KeptMeasurement kept() {
  KeptMeasurement kept{"lab, plugin", {50.0, 1'700'000'123, {0.21, 0.004}, {0.012, 0.001}, {}}};
  kept.measurement.eye.left = {
      {0.2, 0.01}, {2.7, 0.05}, {-0.01, 0.02}, {{0, {41.0, 0.2}, {}}, {1, {39.5, 0.1}, {-12.25, 0.2}}}};
  kept.measurement.eye.right = {{0.22, 0.02}, {2.6, 0.04}, {0.1 + 0.2, 0.01}, {{0, {40.0, 0.3}, {}}}};
  return kept;
}

TEST_CASE("what a rig measured is kept to the last digit, and no file is no fault") {
  const TemporaryFolder folder;
  const auto none = load_measurement(folder / "measured.json");
  REQUIRE(none);
  CHECK_FALSE(*none);
  REQUIRE(save_measurement(folder / "measured.json", kept()));
  const auto back = load_measurement(folder / "measured.json");
  REQUIRE(back);
  CHECK(**back == kept());
}

TEST_CASE("a damaged file is named, with the place in it") {
  std::string text = measurement_text(kept());
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string damaged = text;
    damaged.replace(damaged.find(from), from.size(), to);
    const auto read = parse_measurement(damaged, "measured.json");
    REQUIRE_FALSE(read);
    return read.fault().where;
  };
  CHECK(refused("\"focalstage_measured\": 1", "\"focalstage_measured\": 2") == "measured.json: /focalstage_measured");
  CHECK(refused("\"spread\": 0.004", "\"spread\": -1") == "measured.json: /latency_ms/spread");
  CHECK(refused("\"value\": 2.7", "\"value\": \"2.7\"") == "measured.json: /left/shutter_open_ms/value");
  CHECK_FALSE(parse_measurement(text.substr(0, text.size() / 2), "measured.json"));
  CHECK_FALSE(parse_measurement("[]", "measured.json"));
}

}  // namespace
