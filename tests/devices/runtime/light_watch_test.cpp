#include "devices/runtime/light_watch.h"

#include <set>

#include <doctest/doctest.h>

using namespace focalstage;

namespace {

/// A sensor whose clock is slow: it says what it was asked for, and when by its own clock.
class FakeSensor final : public LightSensor {
 public:
  double clock = 0.996;  ///< of its seconds to a true one
  double period_s = 1.0 / 60.0;
  int whole_after = 2;  ///< askings
  int lost_after = 1000;
  std::vector<LightRequest> requests;

  Status open() override { return {}; }
  void close() override {}
  DeviceId id() const override { return {}; }
  DeviceState state() const override { return {}; }
  Status identify() override { return {}; }
  LightAbilities abilities() const override { return {26e-6, 100, 10}; }
  Status arm(const LightRequest& request) override {
    requests.push_back(request);
    asked_ = 0;
    return {};
  }
  Result<std::optional<LightRecord>> take() override {
    if (static_cast<int>(requests.size()) > lost_after) return Fault{"serial.gone", "light sensor", "gone", ""};
    if (++asked_ < whole_after) return std::optional<LightRecord>();
    const LightRequest& request = requests.back();
    LightRecord record{request.eye, request.after_edge_s, 26e-6, period_s * clock, {}};
    record.light.assign(static_cast<std::size_t>(request.samples), 0.25);
    return std::optional<LightRecord>(record);
  }

 private:
  int asked_ = 0;
};

TEST_CASE("records come on the rig's clock, shifted within a step, in pieces the sensor can take") {
  FakeSensor sensor;
  const LightWatch watch(sensor, 1.0 / 60.0, [] { return Status(); });
  const auto traces = watch.traces({Side::right, 0.001, 0.001 + 180 * 26e-6, 8});
  REQUIRE(traces);
  CHECK(traces->size() == 16);
  std::set<double> begun;
  std::set<int> skipped;
  for (std::size_t i = 0; i < traces->size(); ++i) {
    const LightTrace& trace = (*traces)[i];
    CHECK(trace.step_s == doctest::Approx(26e-6 / 0.996));
    CHECK(trace.first_s == doctest::Approx(sensor.requests[i].after_edge_s / 0.996));
    CHECK(sensor.requests[i].eye == Side::right);
    CHECK(sensor.requests[i].samples <= 100);
    begun.insert(sensor.requests[i].after_edge_s);
    skipped.insert(sensor.requests[i].edges_to_skip);
  }
  CHECK(begun.size() == 16);
  CHECK(*begun.begin() == 0.001);
  CHECK(skipped == std::set<int>{0, 1, 2});
  // The two pieces overlap, and together they are the window.
  CHECK(sensor.requests[8].after_edge_s < 0.001 + 100 * 26e-6);
  CHECK(sensor.requests[15].after_edge_s + sensor.requests[15].samples * 26e-6 > 0.001 + 178 * 26e-6);
}

TEST_CASE("who may not go on, a sensor that is lost, and edges that are not the rig's end it") {
  FakeSensor sensor;
  sensor.whole_after = 1000000;
  int asked = 0;
  const LightWatch watch(sensor, 1.0 / 60.0, [&]() -> Status {
    if (++asked < 5) return {};
    return Fault{"rig.lease", "client", "it is gone", ""};
  });
  CHECK(watch.traces({Side::left, 0.0, 0.001, 4}).fault().code == "rig.lease");
  CHECK(asked == 5);
  const LightWatch free(sensor, 1.0 / 60.0, [] { return Status(); });
  sensor.whole_after = 1;
  sensor.lost_after = 2 + static_cast<int>(sensor.requests.size());
  CHECK(free.traces({Side::left, 0.0, 0.001, 4}).fault().code == "serial.gone");
  sensor.lost_after = 1000;
  sensor.period_s = 1.0 / 50.0;
  const auto other = free.traces({Side::left, 0.0, 0.001, 4});
  REQUIRE_FALSE(other);
  CHECK(other.fault().code == "light.unsynced");
  CHECK(other.fault().message.find("16.667") != std::string::npos);
}

}  // namespace
