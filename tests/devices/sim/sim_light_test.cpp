#include "devices/sim/sim_light.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <doctest/doctest.h>

#include "devices/sim/sim_rig.h"

using namespace focalstage;

namespace {

/// A bench without anything that spoils its signal.
SimSettings clean() {
  SimSettings settings;
  settings.width_px = 64;
  settings.height_px = 48;
  SimLightSettings& light = *settings.light;
  light.noise = light.hum = light.ambient = 0.0;
  light.clock_off = 0.0;
  light.rise_s = 1e-9;
  light.bits = 16;
  return settings;
}

constexpr double period_s = 1.0 / 60.0;

/// Sweeps of one exposure of 2 ms, triggered 5 ms after each edge, through open shutters and lenses at rest.
LightRecord seen(const SimSettings& settings, const std::vector<std::uint8_t>& codes, Side eye) {
  const auto sensor = std::make_shared<SimLightSensor>(*settings.light);
  SimRig rig(settings, {}, sensor);
  rig.set_exposure(0.002, {1, 8});
  REQUIRE(sensor->arm({eye, 0.004, 150}));
  for (int sweep = 1; sweep <= 5; ++sweep) {
    rig.post_images({{nullptr, codes}});
    rig.sync_edge(sweep * period_s);
    rig.trigger(sweep * period_s + 0.005);
    rig.run_until((sweep + 0.9) * period_s);
  }
  const auto taken = sensor->take();
  REQUIRE(taken);
  REQUIRE(*taken);
  return **taken;
}

TEST_CASE("the simulated sensor sees white light when and as long as there is some") {
  const SimSettings settings = clean();
  const LightRecord record = seen(settings, std::vector<std::uint8_t>(64 * 48, 255), Side::left);
  CHECK(record.period_s == doctest::Approx(period_s));
  for (std::size_t i = 0; i < record.light.size(); ++i) {
    const double at_s = record.after_edge_s + static_cast<double>(i) * record.step_s;
    const bool lit = at_s >= 0.00515 && at_s < 0.00715;
    CHECK(record.light[i] == doctest::Approx(lit ? 0.6 : 0.0).epsilon(0.001));
  }
}

TEST_CASE("a line is as bright as its defocus leaves it, each eye its own") {
  SimSettings settings = clean();
  settings.light->lines = {{0.0, 0.0}, {0.12, 0.0}, {1.2, 0.0}};
  for (const auto& [line, share] :
       {std::pair{0, 1.0}, std::pair{1, std::sqrt(0.5)}, std::pair{2, 1.0 / std::sqrt(101.0)}}) {
    std::vector<std::uint8_t> codes(64 * 48, 0);
    const auto [left, top, width, height] = line_rectangle_px(static_cast<std::size_t>(line), Side::left, 64, 48);
    for (int y = top; y < top + height; ++y) {
      for (int x = left; x < left + width; ++x) codes[static_cast<std::size_t>(y * 64 + x)] = 255;
    }
    CHECK(seen(settings, codes, Side::left).light[60] == doctest::Approx(0.4 * share).epsilon(0.02));
    CHECK(seen(settings, codes, Side::right).light[60] < 0.01);
  }
}

TEST_CASE("its clock is its own, and it says nothing where it is unplugged") {
  SimSettings settings = clean();
  settings.light->clock_off = 0.01;
  const LightRecord record = seen(settings, std::vector<std::uint8_t>(64 * 48, 255), Side::left);
  CHECK(record.period_s == doctest::Approx(period_s / 1.01));
  const auto up = std::ranges::find_if(record.light, [](double light) { return light > 0.3; });
  const double own_s = record.after_edge_s + static_cast<double>(up - record.light.begin()) * record.step_s;
  CHECK(own_s * period_s / record.period_s == doctest::Approx(0.00515).epsilon(0.006));
  SimLightSensor sensor(*settings.light);
  CHECK(sensor.arm({Side::left, 0.0, 5000}).fault().code == "light.unable");
  sensor.unplug();
  CHECK(sensor.arm({Side::left, 0.0, 5}).fault().code == "light.gone");
  CHECK(sensor.take().fault().code == "light.gone");
  CHECK(sensor.state().phase == DevicePhase::lost);
  sensor.plug();
  CHECK(sensor.arm({Side::left, 0.0, 5}));
}

}  // namespace
