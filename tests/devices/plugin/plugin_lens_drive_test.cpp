#include "devices/plugin/plugin_lens_drive.h"

#include <cmath>

#include <doctest/doctest.h>

#include "tests/devices/plugin/conformance.h"

namespace focalstage {
namespace {

using test::within;

PluginDriveSettings null_drive(std::map<std::string, std::string> options = {}) {
  PluginDriveSettings settings;
  settings.plugin.library = std::string(FOCALSTAGE_BINARY_DIR) + "/plugins/focalstage-null_drive.so";
  settings.plugin.options = std::move(options);
  return settings;
}

DrivePeriod sine(double amplitude_a, double period_s = 0.020) {
  DrivePeriod period;
  period.period_s = period_s;
  for (int i = 0; i < 100; ++i) period.drive_a.left.push_back(amplitude_a * std::sin(6.283185307179586 * i / 100.0));
  period.drive_a.right = period.drive_a.left;
  return period;
}

TEST_CASE("a drive behind a plugin begins, refills, counts and stops") {
  const auto drive = make_plugin_lens_drive(null_drive());
  CHECK_FALSE(drive->start(sine(0.1)).ok());  // it is not open
  REQUIRE(drive->open().ok());
  CHECK(drive->id().model == "null drive");
  CHECK(drive->abilities().eyes_apart);
  CHECK(drive->abilities().most_a == 0.25);  // ours is less than the plugin's
  CHECK(drive->state().phase == DevicePhase::ready);
  REQUIRE(drive->start(sine(0.1)).ok());
  CHECK(drive->state().phase == DevicePhase::running);
  REQUIRE(within(3.0, [&] { return drive->report().periods >= 5; }));
  const DriveReport report = drive->report();
  CHECK(report.period_s == doctest::Approx(0.020));
  CHECK(std::abs(monotonic_s() - report.newest_period_s) < 0.5);
  CHECK(report.underruns == 0);
  CHECK(report.clamped == 0);
  const auto from = drive->refill(sine(0.2));
  REQUIRE(from.ok());
  CHECK(*from > report.periods);
  CHECK(drive->refill(sine(0.2, 0.030)).fault().code == "drive.unable");
  const double told_s = monotonic_s();
  CHECK(drive->stop());
  CHECK(monotonic_s() - told_s < 0.1);
  CHECK(drive->state().phase == DevicePhase::ready);
  REQUIRE(drive->start(sine(0.1)).ok());
  CHECK(drive->report().periods < 5);
  drive->close();
  CHECK(drive->state().phase == DevicePhase::off);
}

TEST_CASE("what goes beyond the limit is cut before the plugin sees it") {
  // The plugin refuses all beyond 0.2 A, so that a start that succeeds shows the cut.
  const auto drive = make_plugin_lens_drive(null_drive({{"most_a", "0.2"}}));
  REQUIRE(drive->open().ok());
  CHECK(drive->abilities().most_a == 0.2);
  DrivePeriod wild = sine(0.2);
  wild.drive_a.left[7] = 5.0;
  wild.drive_a.right[8] = -5.0;
  wild.drive_a.right[9] = std::nan("");
  REQUIRE(drive->start(wild).ok());
  CHECK(drive->report().clamped == 3);
}

TEST_CASE("eyes that differ need a channel each") {
  const auto drive = make_plugin_lens_drive(null_drive({{"apart", "0"}}));
  REQUIRE(drive->open().ok());
  DrivePeriod period = sine(0.1);
  period.drive_a.right[3] = 0.0;
  CHECK(drive->start(period).fault().code == "drive.unable");
  CHECK(drive->start(sine(0.1)).ok());
  CHECK(drive->start({}).fault().code == "drive.unable");
}

TEST_CASE("a drive whose plugin is none says so") {
  PluginDriveSettings settings = null_drive();
  settings.plugin.library = std::string(FOCALSTAGE_BINARY_DIR) + "/plugins/focalstage-null.so";
  const auto drive = make_plugin_lens_drive(settings);
  CHECK(drive->open().fault().code == "plugin.symbol");
  CHECK(drive->state().phase == DevicePhase::refused);
  CHECK(make_plugin_lens_drive(null_drive({{"volts", "9"}}))->open().fault().code == "plugin.settings");
}

}  // namespace
}  // namespace focalstage
