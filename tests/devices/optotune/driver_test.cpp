#include "devices/optotune/driver.h"

#include <cmath>
#include <functional>
#include <thread>

#include <doctest/doctest.h>

#include "devices/optotune/probe.h"
#include "devices/roles/clock.h"
#include "tests/devices/optotune/emulator/line.h"

namespace focalstage {
namespace {

namespace emulated = optotune_emulator;

std::unique_ptr<emulated::Line> plugged(const emulated::Options& options = {}) {
  auto line = emulated::Line::open(options);
  REQUIRE(line);
  return line;
}

OptotuneSettings settings_of(const emulated::Line& line) {
  OptotuneSettings settings;
  settings.search.sysfs = "/nonexistent";  // nothing that is really plugged in
  settings.search.paths = {line.path()};
  settings.answer_s = 0.25;  // the emulator shares a busy machine
  return settings;
}

bool opened(OptotuneLens& lens) {
  const Status status = lens.open();
  if (!status) MESSAGE(describe(status.fault()));
  return status.ok();
}

bool until(const std::function<bool()>& so, double longest_s) {
  const double start_s = monotonic_s();
  while (!so()) {
    if (monotonic_s() - start_s > longest_s) return false;
    sleep_until(monotonic_s() + 0.002);
  }
  return true;
}

double given_a(const emulated::Line& line) {
  const auto now = line.snapshot();
  return now.mode() == 1 ? now.counts() * now.centi_ma() * 1e-5 / 4095.0 : 0.0;
}

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

TEST_CASE("silent, half, damaged for ever or hung up: lost within 500 ms, and open finds it again") {
  struct Case {
    std::string name;
    emulated::Misbehaviour how;
    std::string code;
  };
  emulated::Misbehaviour silent;
  silent.silent = true;
  emulated::Misbehaviour half;
  half.half = 3;
  emulated::Misbehaviour damaged;
  damaged.damage = true;
  emulated::Misbehaviour hung;
  hung.hang_up_at = 5;
  for (const Case& one : {Case{"silent", silent, "serial.timeout"}, Case{"half", half, "serial.timeout"},
                          Case{"damaged", damaged, "optotune.damaged"}, Case{"hung up", hung, "serial.gone"}}) {
    CAPTURE(one.name);
    const auto line = plugged();
    OptotuneSettings settings = settings_of(*line);
    settings.answer_s = OptotuneSettings{}.answer_s;
    const auto lens = make_optotune(settings);
    REQUIRE(opened(*lens));
    REQUIRE(lens->set_current(0.1).ok());
    const double start_s = monotonic_s();
    line->misbehave(one.how);
    REQUIRE(until([&] { return lens->state().phase == DevicePhase::lost; }, 2.0));
    CHECK(monotonic_s() - start_s < 0.7);
    CHECK(lens->state().fault->code == one.code);
    CHECK_FALSE(lens->stop());
    CHECK_FALSE(lens->set_current(0.1).ok());
    line->misbehave({});
    if (one.how.hang_up_at) continue;
    REQUIRE(opened(*lens));
    CHECK(line->snapshot().counts() == 0);
  }
}

TEST_CASE("cut off after any byte of opening it is a fault, within 3 s") {
  for (std::size_t byte = 0; byte < 80; byte += 7) {
    CAPTURE(byte);
    const auto line = plugged();
    emulated::Misbehaviour how;
    how.hang_up_at = byte;
    line->misbehave(how);
    const auto lens = make_optotune(settings_of(*line));
    const double start_s = monotonic_s();
    if (lens->open()) REQUIRE(until([&] { return lens->state().phase == DevicePhase::lost; }, 2.0));
    CHECK(monotonic_s() - start_s < 3.0);
    CHECK(lens->state().phase == DevicePhase::lost);
    CHECK(lens->state().fault.has_value());
  }
}

TEST_CASE("each refusal has its own name; what only adds to safety may be lacking") {
  const std::string codes[] = {"optotune.checksum", "optotune.unavailable", "optotune.unknown", "optotune.lens"};
  for (int error = 1; error <= 4; ++error) {
    for (const bool digit : {false, true}) {
      const auto line = plugged();
      emulated::Misbehaviour how;
      how.error = error;
      how.error_on = "CwMA";
      how.error_as_digit = digit;
      line->misbehave(how);
      CHECK(make_optotune(settings_of(*line))->open().fault().code == codes[error - 1]);
    }
  }
  for (const std::string name : {"CwUA", "V", "X"}) {
    const auto line = plugged();
    emulated::Misbehaviour how;
    how.error = 3;
    how.error_on = name;
    line->misbehave(how);
    CHECK(make_optotune(settings_of(*line))->open().ok());
  }
  const auto line = plugged();
  const auto lens = make_optotune(settings_of(*line));
  REQUIRE(opened(*lens));
  emulated::Misbehaviour how;
  how.error = 4;
  how.error_on = "Aw";  // silent where it succeeds
  line->misbehave(how);
  CHECK(lens->set_current(0.1).fault().code == "optotune.lens");
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

TEST_CASE("one damaged or late answer is no loss, a stale one is not believed, wide limits are a setting") {
  const auto line = plugged(emulated::Options{'E', "ANAB0042", true});
  OptotuneSettings settings = settings_of(*line);
  settings.wide_limits = true;
  const auto lens = make_optotune(settings);
  REQUIRE(opened(*lens));
  emulated::Misbehaviour how;
  how.damage_once = true;
  how.delay_s = 0.03;
  line->misbehave(how);
  sleep_until(monotonic_s() + 0.6);
  CHECK(lens->state().phase == DevicePhase::ready);
  line->misbehave({});
  REQUIRE(lens->set_current(0.1).ok());
  CHECK(lens->report().most_a == 0.25);
}

TEST_CASE("a device that was reset is noticed, and is at zero") {
  const auto line = plugged();
  const auto lens = make_optotune(settings_of(*line));
  REQUIRE(opened(*lens));
  REQUIRE(lens->set_current(0.1).ok());
  line->reset();
  REQUIRE(until([&] { return lens->state().fault.has_value(); }, 1.0));
  CHECK(lens->state().fault->code == "optotune.mode");
  CHECK(line->snapshot().mode() == 1);
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
