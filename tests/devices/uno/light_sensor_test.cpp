#include "devices/uno/light_sensor.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "devices/uno/light_words.h"
#include "tests/devices/uno/plugged_in.h"

using namespace focalstage;

namespace {

/// A board whose photodiodes see light from 5 to 8 ms after each edge (left) and always half (right).
struct Bench {
  test::PluggedIn there;
  std::unique_ptr<LightSensor> sensor;

  explicit Bench(const uno_emulator::Pace& pace = {}) : there(pace, {}, test::quick_boot()) {
    const double cycles_per_s = 16e6 * (1.0 + 1e-6 * pace.clock_ppm);
    there.board.with([&](uno_emulator::UnoEmulator& emulator) {
      emulator.chip().set_analogue([&chip = emulator.chip(), cycles_per_s](int input, double cycle) {
        if (input == 1) return 0.5;
        if (chip.edges.empty()) return 0.0;
        const double since_s = (cycle - static_cast<double>(chip.edges.back())) / cycles_per_s;
        return since_s > 0.005 && since_s < 0.008 ? 0.8 : 0.1;
      });
    });
    UnoLightSettings settings;
    settings.board = there.settings;
    sensor = make_uno_light(settings);
  }

  std::optional<LightRecord> record(const LightRequest& request) const {
    REQUIRE(sensor->arm(request));
    std::optional<LightRecord> found;
    test::PluggedIn::soon([&] {
      auto taken = sensor->take();
      REQUIRE(taken);
      found = std::move(*taken);
      return found.has_value();
    });
    return found;
  }
};

TEST_CASE("a record is what stood at the input, and when, by the period that both clocks know") {
  for (const double ppm : {0.0, 4000.0}) {
    uno_emulator::Pace pace;
    pace.clock_ppm = ppm;
    const Bench bench(pace);
    REQUIRE(bench.sensor->open());
    CHECK(bench.sensor->state().phase == DevicePhase::ready);
    REQUIRE(test::PluggedIn::soon([&] { return bench.sensor->arm({Side::left, 0.004, 2}) && bench.sensor->take(); }));
    test::wait_s(0.3);
    const auto found = bench.record({Side::left, 0.004, 100});
    REQUIRE(found);
    REQUIRE(found->light.size() == 100);
    const double scale = (1.0 / 60.0) / found->period_s;
    CHECK(scale == doctest::Approx(1.0 - 1e-6 * ppm).epsilon(2e-4));
    CHECK(found->light.front() == doctest::Approx(0.1).epsilon(0.01));
    CHECK(found->light.back() == doctest::Approx(0.8).epsilon(0.01));
    const auto up = std::ranges::find_if(found->light, [](double light) { return light > 0.45; });
    const double seen_s =
        (found->after_edge_s + static_cast<double>(up - found->light.begin()) * found->step_s) * scale;
    CHECK(seen_s > 0.005 - 3e-6);
    CHECK(seen_s < 0.005 + 29e-6);
    const auto right = bench.record({Side::right, 0.004, 20});
    REQUIRE(right);
    for (const double light : right->light) CHECK(light == doctest::Approx(0.5).epsilon(0.005));
  }
}

TEST_CASE("a sensor without edges says so; one that is unplugged is lost, and found again") {
  uno_emulator::Pace pace;
  pace.sync_hz = 0.0;
  Bench bench(pace);
  CHECK(bench.sensor->arm({Side::left, 0.001, 10}).fault().code == "uno.closed");
  REQUIRE(bench.sensor->open());
  REQUIRE(bench.sensor->arm({Side::left, 0.001, 10}));
  std::string code;
  REQUIRE(test::PluggedIn::soon([&] {
    const auto taken = bench.sensor->take();
    if (!taken) code = taken.fault().code;
    return !taken;
  }));
  CHECK(code == "light.unsynced");
  bench.there.board.with([](uno_emulator::UnoEmulator& emulator) { emulator.unplug(); });
  const auto gone = bench.sensor->arm({Side::left, 0.001, 10});
  REQUIRE_FALSE(gone);
  CHECK(bench.sensor->state().phase == DevicePhase::lost);
  CHECK(bench.sensor->state().fault);
  CHECK_FALSE(bench.sensor->open());
  bench.there.board.with([](uno_emulator::UnoEmulator& emulator) { emulator.plug_in(); });
  CHECK(test::PluggedIn::soon([&] { return bench.sensor->open().ok(); }));
}

TEST_CASE("what a board says of light is read strictly") {
  using uno::LightLine;
  const auto line = uno::decode_light("2 4000 240");
  REQUIRE(line);
  CHECK(line->state == LightLine::State::whole);
  CHECK(line->after_s == doctest::Approx(0.002));
  CHECK(line->samples == 240);
  for (const char* bad : {"", "2", "2 1", "4 1 1", "2 70000 1", "2 1 241", "2 1 1 ", " 2 1 1", "a 1 1", "2 -1 1"}) {
    CHECK_FALSE(uno::decode_light(bad));
  }
  const auto samples = uno::decode_samples("0003FF1FF");
  REQUIRE(samples);
  CHECK((*samples)[0] == 0.0);
  CHECK((*samples)[1] == 1.0);
  CHECK((*samples)[2] == doctest::Approx(511.0 / 1023.0));
  for (const char* bad : {"", "00", "0000", "00G", "400", "-01"}) CHECK_FALSE(uno::decode_samples(bad));
}

}  // namespace
