#include "devices/optotune/driver.h"

#include <cmath>
#include <thread>

#include <doctest/doctest.h>

#include "devices/optotune/probe.h"
#include "tests/devices/optotune/bench.h"

namespace focalstage {
namespace {

TEST_CASE("opening sets it up: no current, the limit in the device itself, and who it is") {
  const auto line = plugged();
  const auto lens = make_optotune(settings_of(*line));
  CHECK(lens->state().phase == DevicePhase::off);
  REQUIRE(opened(*lens));
  CHECK(lens->state().phase == DevicePhase::ready);
  CHECK(line->snapshot().mode() == 1);
  CHECK(line->snapshot().centi_ma() == 25000);
  const auto report = lens->report();
  CHECK(report.lens_serial == "ANAB0042");
  CHECK(report.firmware == "E 1.12.240.800");
  CHECK(report.most_a == 0.25);
  CHECK(lens->id().address == line->path());
  CHECK(line->snapshot().asked().at("CwUA") == 1);
  CHECK(line->snapshot().asked().at("CwLA") == 1);
  CHECK(line->snapshot().asked().count("Zw") == 0);
  REQUIRE(until([&] { return lens->report().celsius.has_value(); }, 1.0));
  CHECK(lens->report().celsius == 25.0);
  CHECK(lens->state().temperatures.at(0).celsius == 25.0);
  REQUIRE(opened(*lens));
  lens->close();
  CHECK(lens->state().phase == DevicePhase::off);
}

TEST_CASE("a current is given and cut at the limit, whatever is asked; the end is zero") {
  const auto line = plugged();
  OptotuneSettings settings = settings_of(*line);
  settings.most_a = 4.0;
  const auto lens = make_optotune(settings);
  REQUIRE(opened(*lens));
  CHECK(line->snapshot().centi_ma() == 29000);
  REQUIRE(lens->set_current(-0.1).ok());
  CHECK(lens->state().phase == DevicePhase::running);
  REQUIRE(until([&] { return std::abs(given_a(*line) + 0.1) < 1e-4; }, 0.5));
  REQUIRE(lens->set_current(7.0).ok());
  REQUIRE(until([&] { return given_a(*line) > 0.28; }, 0.5));
  CHECK(given_a(*line) < optotune_hard_limit_a + 1e-9);
  CHECK(lens->report().clamped == 1);
  CHECK(lens->set_current(0.0 / 0.0).fault().code == "optotune.unable");
  const double start_s = monotonic_s();
  CHECK(lens->stop());
  CHECK(monotonic_s() - start_s < 0.5);
  CHECK(until([&] { return line->snapshot().counts() == 0; }, 0.1));
  CHECK(line->snapshot().asked().at("Aw") >= 9);  // by halves
  CHECK(lens->state().phase == DevicePhase::ready);
  REQUIRE(lens->set_current(0.05).ok());
  lens->close();
  CHECK(line->snapshot().counts() == 0);
}

TEST_CASE("analogue mode follows the input until it is stopped") {
  const auto line = plugged();
  const auto lens = make_optotune(settings_of(*line));
  REQUIRE(opened(*lens));
  REQUIRE(lens->follow_input().ok());
  CHECK(line->snapshot().mode() == 6);
  CHECK(lens->state().phase == DevicePhase::running);
  CHECK(lens->set_current(0.1).fault().code == "optotune.mode");
  CHECK(lens->identify().fault().code == "optotune.running");
  CHECK(lens->stop());
  CHECK(line->snapshot().mode() == 1);
  REQUIRE(lens->set_current(0.1).ok());
}

TEST_CASE("it warns at 45 C, stops at 50 C, and may go on once it has cooled") {
  const auto line = plugged();
  OptotuneSettings settings = settings_of(*line);
  settings.temperature_s = 0.1;
  const auto lens = make_optotune(settings);
  REQUIRE(opened(*lens));
  REQUIRE(lens->set_current(0.2).ok());
  line->heat(46.0);
  REQUIRE(until([&] { return lens->report().warm; }, 2.0));
  CHECK(lens->state().phase == DevicePhase::running);
  line->heat(50.5);
  REQUIRE(until([&] { return lens->state().fault.has_value(); }, 2.0));
  CHECK(lens->state().fault->code == "optotune.hot");
  CHECK(lens->state().phase == DevicePhase::ready);
  CHECK(line->snapshot().counts() == 0);
  line->heat(46.0);
  REQUIRE(until([&] { return lens->report().celsius == 46.0; }, 2.0));
  CHECK(lens->set_current(0.1).fault().code == "optotune.hot");
  line->heat(43.0);
  REQUIRE(until([&] { return lens->set_current(0.1).ok(); }, 2.0));
  CHECK_FALSE(lens->state().fault.has_value());
}

TEST_CASE("a device that does not take the limit is not driven") {
  const auto line = plugged();
  emulated::Misbehaviour how;
  how.keeps_limit = true;
  line->misbehave(how);
  const auto lens = make_optotune(settings_of(*line));
  CHECK(lens->open().fault().code == "optotune.limit");
  CHECK(lens->state().phase == DevicePhase::refused);
  CHECK_FALSE(lens->set_current(0.1).ok());
  CHECK(line->snapshot().counts() == 0);
}

TEST_CASE("none or too many are faults, and probing opens nothing") {
  const auto line = plugged();
  OptotuneSettings settings = settings_of(*line);
  REQUIRE(probe_optotune(settings.search).size() == 1);
  CHECK(probe_optotune(settings.search)[0].address == line->path());
  CHECK(line->snapshot().asked().empty());
  const auto other = plugged();
  settings.search.paths.push_back(other->path());
  CHECK(make_optotune(settings)->open().fault().code == "optotune.which");
  settings.search.paths.clear();
  CHECK(make_optotune(settings)->open().fault().code == "optotune.missing");
}

TEST_CASE("identify moves the lens and ends at zero") {
  const auto line = plugged();
  const auto lens = make_optotune(settings_of(*line));
  REQUIRE(opened(*lens));
  bool moved = false;
  std::jthread looking([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      moved = moved || line->snapshot().counts() != 0;
      sleep_until(monotonic_s() + 0.01);
    }
  });
  const double start_s = monotonic_s();
  REQUIRE(lens->identify().ok());
  CHECK(monotonic_s() - start_s < 2.0);
  looking.request_stop();
  looking.join();
  CHECK(moved);
  CHECK(line->snapshot().counts() == 0);
}

}  // namespace
}  // namespace focalstage
