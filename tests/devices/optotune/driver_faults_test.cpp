#include "devices/optotune/driver.h"

#include <string>

#include <doctest/doctest.h>

#include "tests/devices/optotune/bench.h"

namespace focalstage {
namespace {

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

}  // namespace
}  // namespace focalstage
