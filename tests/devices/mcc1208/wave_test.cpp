#include "devices/mcc1208/wave.h"

#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "devices/mcc1208/packets.h"

namespace focalstage {
namespace {

Mcc1208Settings bipolar() {
  Mcc1208Settings settings;
  settings.amperes_per_volt = 0.12;
  return settings;
}

DrivePeriod both(std::vector<double> drive_a, double period_s = 1.0 / 60.0) { return {period_s, {drive_a, drive_a}}; }

int u16(const std::vector<std::uint8_t>& bytes, std::size_t at) { return bytes[at] | bytes[at + 1] << 8; }
int lens(const Mcc1208Wave& wave, std::size_t scan) { return u16(wave.bytes, 4 * scan); }
int sync(const Mcc1208Wave& wave, std::size_t scan) { return u16(wave.bytes, 4 * scan + 2); }

std::string refused(const DrivePeriod& period, const Mcc1208Settings& settings) {
  const auto wave = mcc1208_wave(period, settings);
  return wave ? "" : wave.fault().code;
}

TEST_CASE("60 Hz is 400 scans of both channels, 25 whole packets, with one edge at the first") {
  const auto wave = mcc1208_wave(both({0.0, 0.1, 0.0, -0.1}), bipolar());
  REQUIRE(wave.ok());
  CHECK(wave->pacer == 2499);
  CHECK(wave->period_s == doctest::Approx(1.0 / 60.0).epsilon(1e-15));
  REQUIRE(wave->bytes.size() == 25 * mcc_packet_bytes);
  for (std::size_t i = 0; i < 400; ++i) CHECK(sync(*wave, i) == (i < 24 ? 4095 : 0));
}

TEST_CASE("samples in between are on the line between their neighbours, round the ring") {
  const auto wave = mcc1208_wave(both({0.0, 0.1, 0.0, -0.1}), bipolar());
  REQUIRE(wave.ok());
  const double codes_per_a = 4096.0 / 5.0 / 0.12;
  CHECK(lens(*wave, 0) == 2048);
  CHECK(lens(*wave, 50) == 2048 + std::lround(0.05 * codes_per_a));
  CHECK(lens(*wave, 100) == 2048 + std::lround(0.1 * codes_per_a));
  CHECK(lens(*wave, 300) == 2048 - std::lround(0.1 * codes_per_a));
  CHECK(lens(*wave, 350) == 2048 - std::lround(0.05 * codes_per_a));
  CHECK(lens(*wave, 399) == 2048 - std::lround(0.001 * codes_per_a));
  CHECK(wave->clamped == 0);
}

TEST_CASE("no current is beyond the limit, and what was cut is counted") {
  Mcc1208Settings settings = bipolar();
  settings.samples = 4;
  settings.most_a = 0.2;
  const auto wave = mcc1208_wave(both({0.2, 0.5, -0.2001, -1e9}, 1e-3), settings);
  REQUIRE(wave.ok());
  CHECK(wave->clamped == 3);
  for (std::size_t i = 0; i < 4; ++i) CHECK(std::abs(mcc_volts(lens(*wave, i)) - 2.5) * 0.12 <= 0.2);
  CHECK(lens(*wave, 0) == lens(*wave, 1));
  CHECK(lens(*wave, 2) == lens(*wave, 3));
}

TEST_CASE("the hard limit holds whatever the settings say, and a limit that is no number lets nothing through") {
  Mcc1208Settings settings = bipolar();
  settings.most_a = 5.0;
  CHECK(mcc1208_most_a(settings) == mcc1208_hard_limit_a);
  settings.amperes_per_volt = 0.1;
  settings.zero_code = 3000;
  CHECK(mcc1208_most_a(settings) == doctest::Approx(1095 * mcc_volts(1) * 0.1));
  settings.most_a = std::numeric_limits<double>::quiet_NaN();
  std::uint64_t clamped = 0;
  CHECK(mcc1208_code(0.1, settings, clamped) == 3000);
  CHECK(clamped == 1);
  settings.most_a = -1.0;
  CHECK(mcc1208_most_a(settings) == 0.0);
}

TEST_CASE("an amplifier that turns the sign is turned back") {
  Mcc1208Settings settings = bipolar();
  settings.amperes_per_volt = -0.12;
  std::uint64_t clamped = 0;
  CHECK(mcc1208_code(0.1, settings, clamped) == 2048 - std::lround(0.1 / 0.12 * 4096.0 / 5.0));
  CHECK(mcc1208_code(9.0, settings, clamped) == 2048 - 1706);
}

TEST_CASE("what cannot be made is refused by name") {
  const Mcc1208Settings settings = bipolar();
  DrivePeriod apart = both({0.0, 0.1});
  apart.drive_a.right[1] = 0.2;
  CHECK(refused(apart, settings) == "drive.unable");
  CHECK(refused(both({}), settings) == "drive.unable");
  CHECK(refused(both({0.0, std::numeric_limits<double>::quiet_NaN()}), settings) == "drive.unable");
  CHECK(refused(both({0.0}, 0.0), settings) == "drive.unable");
  CHECK(refused(both({0.0}, std::numeric_limits<double>::infinity()), settings) == "drive.unable");
  CHECK(refused(both({0.0}, 1.0 / 75.0), settings) == "drive.unable");  // 30 kS/s
  CHECK(refused(both({0.0}), Mcc1208Settings{}) == "drive.unable");     // an amplifier nobody measured
  CHECK(refused(both({0.0}), settings) == "");
}

TEST_CASE("a rate that the pacer misses is told, and refused where it is too far off") {
  Mcc1208Settings settings = bipolar();
  const DrivePeriod ntsc = both({0.0, 0.1}, 1.0 / 59.94);
  CHECK(refused(ntsc, settings) == "drive.unable");
  settings.most_off_ppm = 250.0;
  const auto wave = mcc1208_wave(ntsc, settings);
  REQUIRE(wave.ok());
  CHECK(wave->pacer == 2502);
  CHECK(wave->period_s == doctest::Approx(400.0 * 2503.0 / 60e6));
  CHECK(1e6 * (wave->period_s * 59.94 - 1.0) == doctest::Approx(198.8).epsilon(0.01));
}

TEST_CASE("the lead-in goes from no current to the first sample in whole packets without an edge") {
  const Mcc1208Settings settings = bipolar();
  CHECK(mcc1208_lead_in(2048, 24e3, settings).empty());
  const auto bytes = mcc1208_lead_in(3000, 24e3, settings);
  REQUIRE(bytes.size() == 960 * 4);
  CHECK(bytes.size() % mcc_packet_bytes == 0);
  CHECK(u16(bytes, 0) == 2048);
  for (std::size_t i = 0; i < 960; ++i) CHECK(u16(bytes, 4 * i + 2) == 0);
  for (std::size_t i = 1; i < 960; ++i) {
    const int step = u16(bytes, 4 * i) - u16(bytes, 4 * i - 4);
    CHECK((step == 0 || step == 1));
  }
  CHECK(u16(bytes, 959 * 4) == 2999);
}

TEST_CASE("settings that make no sense are named, and nothing is opened with them") {
  CHECK(check_mcc1208(Mcc1208Settings{}).ok());
  const auto named = [](void (*spoil)(Mcc1208Settings&), const std::string& name) {
    Mcc1208Settings settings = bipolar();
    spoil(settings);
    const Status checked = check_mcc1208(settings);
    return !checked && checked.fault().message.find(name) != std::string::npos &&
           refused(both({0.0}), settings) == "mcc1208.settings";
  };
  CHECK(named([](Mcc1208Settings& s) { s.zero_code = 4096; }, "zero_code"));
  CHECK(named([](Mcc1208Settings& s) { s.enable_bit = 16; }, "enable_bit"));
  CHECK(named([](Mcc1208Settings& s) { s.samples = 1; }, "samples"));
  CHECK(named([](Mcc1208Settings& s) { s.amperes_per_volt = 1.0 / 0.0; }, "amperes_per_volt"));
  CHECK(named([](Mcc1208Settings& s) { s.ramp_s = 0.0 / 0.0; }, "ramp_s"));
  CHECK(named([](Mcc1208Settings& s) { s.queued_periods = 2; }, "queued_periods"));
  CHECK(named([](Mcc1208Settings& s) { s.answer_s = 0.0; }, "answer_s"));
}

}  // namespace
}  // namespace focalstage
