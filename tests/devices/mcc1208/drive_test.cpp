#include "devices/mcc1208/drive.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "devices/mcc1208/probe.h"
#include "tests/devices/mcc1208/bench.h"

namespace focalstage {
namespace {

// Scans of the first period on: the lead-in has no edge.
std::vector<emulated::Output> from_first_edge(std::vector<emulated::Output> scans) {
  const auto edge = std::find_if(scans.begin(), scans.end(), [](const auto& scan) { return scan.codes[1] > 2048; });
  scans.erase(scans.begin(), edge);
  return scans;
}

TEST_CASE("10 s of device time are what was asked, sample for sample, one edge per 400, none missing") {
  Bench bench;
  const auto drive = make_mcc1208(bench_settings());
  REQUIRE(drive->open().ok());
  CHECK(drive->state().phase == DevicePhase::ready);
  CHECK(at_rest(bench));
  CHECK_FALSE(enabled(bench));
  const DrivePeriod period = sine(0.2, 0.5);
  const double started_s = monotonic_s();
  REQUIRE(drive->start(period).ok());
  CHECK(drive->state().phase == DevicePhase::running);
  CHECK(enabled(bench));
  REQUIRE(until([&] { return bench.scan_count() > 24000 * 10 + 2000; }, 60.0));
  const auto begun = [&] { return (from_first_edge(bench.scans()).size() + 399) / 400; };
  const auto begun_before = begun();
  const DriveReport report = drive->report();
  const auto begun_after = begun();
  const auto told_s = monotonic_s();
  const auto played = from_first_edge(bench.scans());
  CHECK(drive->stop());
  CHECK(at_rest(bench));
  CHECK_FALSE(enabled(bench));

  const auto codes = codes_of(period);
  REQUIRE(played.size() >= 240000);
  int wrong = 0;
  for (std::size_t i = 0; i < played.size(); ++i) {
    if (played[i].codes[0] != codes[i % 400]) ++wrong;
    if (played[i].codes[1] != (i % 400 < 24 ? 4095 : 0)) ++wrong;
    if (*played[i].scan != *played[0].scan + i) ++wrong;
  }
  CHECK(wrong == 0);
  CHECK(played[239999].time_s - played[0].time_s == doctest::Approx(239999 / 24e3).epsilon(1e-12));
  CHECK(report.period_s == doctest::Approx(1.0 / 60.0).epsilon(1e-15));
  CHECK(report.underruns == 0);
  CHECK(report.clamped == 0);
  CHECK(report.periods + 1 >= begun_before);
  CHECK(report.periods <= begun_after + 1);
  CHECK(report.newest_period_s > started_s);
  CHECK(report.newest_period_s <= told_s);
  MESSAGE("10 s took ", told_s - started_s, " s; periods begun ", begun_before, " to ", begun_after, ", told ",
          report.periods);

  const auto starts = sent(bench, 0x1a);
  REQUIRE(starts.size() == 1);
  CHECK(starts[0].data == emulated::Bytes{0, 0, 0, 0, 0xc3, 0x09, 0, 0, 3});
  for (const std::uint8_t never : {0x30, 0x31, 0x50}) CHECK(sent(bench, never).empty());
}

TEST_CASE("a refill begins at the period it names, and nothing is lost or said twice around it") {
  Bench bench;
  const auto drive = make_mcc1208(bench_settings());
  REQUIRE(drive->open().ok());
  const std::vector<DrivePeriod> periods{sine(0.1), sine(0.2), sine(0.15, 1.0), sine(0.05)};
  REQUIRE(drive->start(periods[0]).ok());
  std::vector<std::uint64_t> from{1};
  for (std::size_t i = 1; i < periods.size(); ++i) {
    wait_s(0.15);
    const auto number = drive->refill(periods[i]);
    REQUIRE(number.ok());
    from.push_back(*number);
  }
  REQUIRE(until([&] { return bench.scan_count() / 400 > from.back() + 5; }, 10.0));
  drive->stop();
  const auto played = from_first_edge(bench.scans());
  int wrong = 0;
  for (std::size_t i = 0; i < played.size(); ++i) {
    std::size_t which = 0;
    while (which + 1 < from.size() && from[which + 1] <= i / 400 + 1) ++which;
    if (played[i].codes[0] != codes_of(periods[which])[i % 400]) ++wrong;
    if (played[i].codes[1] != (i % 400 < 24 ? 4095 : 0)) ++wrong;
  }
  CHECK(wrong == 0);
}

TEST_CASE("no scan goes beyond the limit, and current rises from zero without a jump") {
  Bench bench;
  Mcc1208Settings settings = bench_settings();
  settings.most_a = 0.15;
  const auto drive = make_mcc1208(settings);
  REQUIRE(drive->open().ok());
  CHECK(drive->abilities().most_a == 0.15);
  REQUIRE(drive->start(sine(0.3, 1.5)).ok());
  REQUIRE(until([&] { return bench.scan_count() > 4000; }, 10.0));
  drive->stop();
  CHECK(drive->report().clamped > 200);
  const auto scans = bench.scans();
  const int most = static_cast<int>(0.15 / 0.12 * 4096 / 5);
  int beyond = 0;
  for (const auto& scan : scans) beyond += std::abs(scan.codes[0] - 2048) > most ? 1 : 0;
  CHECK(beyond == 0);
  CHECK(std::abs(scans[0].codes[0] - 2048) <= 2);
  for (std::size_t i = 1; i < 960; ++i) CHECK(std::abs(scans[i].codes[0] - scans[i - 1].codes[0]) <= 2);
}

TEST_CASE("stopping is over within 100 ms, ramps and ends at the zero code with the amplifier off") {
  Bench bench;
  const auto drive = make_mcc1208(bench_settings());
  REQUIRE(drive->open().ok());
  REQUIRE(drive->start(sine(0.25, 1.57)).ok());
  wait_s(0.3);
  const double start_s = monotonic_s();
  CHECK(drive->stop());
  const double took_s = monotonic_s() - start_s;
  CHECK(took_s < 0.1);
  MESSAGE("stopping took ", 1e3 * took_s, " ms");
  CHECK(drive->state().phase == DevicePhase::ready);
  CHECK(at_rest(bench));
  CHECK_FALSE(enabled(bench));
  wait_s(0.02);
  auto outputs = bench.outputs();
  const auto last_scan =
      std::find_if(outputs.rbegin(), outputs.rend(), [](const auto& o) { return o.scan.has_value(); });
  const std::vector<emulated::Output> after(last_scan.base() - 1, outputs.end());
  CHECK(after.size() >= 5);
  int left = std::abs(after[0].codes[0] - 2048);
  for (const auto& output : after) {  // nearer to zero with each step
    CHECK(std::abs(output.codes[0] - 2048) <= left);
    left = std::abs(output.codes[0] - 2048);
  }
  CHECK(drive->stop());  // and again: nothing to do, nothing wrong
  REQUIRE(drive->start(sine(0.1)).ok());
  CHECK(drive->state().phase == DevicePhase::running);
  drive->close();
  CHECK(drive->state().phase == DevicePhase::off);
  CHECK(at_rest(bench));
}

TEST_CASE("an amplifier nobody measured gets no output at all") {
  Bench bench;
  Mcc1208Settings settings = bench_settings();
  settings.amperes_per_volt = 0.0;
  const auto drive = make_mcc1208(settings);
  REQUIRE(drive->open().ok());
  CHECK(drive->start(sine(0.1)).fault().code == "drive.unable");
  drive->close();
  wait_s(0.02);
  CHECK(bench.device().codes() == std::array<int, 2>{0, 0});  // as it was powered on
  CHECK(sent(bench, 0x18).empty());
  CHECK(sent(bench, 0x1a).empty());
}

TEST_CASE("it is found by its serial number, and blinks while nothing runs") {
  Bench bench;
  const auto found = probe_mcc1208();
  REQUIRE(found.size() == 1);
  CHECK(found[0] == DeviceId{"mcc1208", "USB-1208FS-Plus", "01D0F1A2", "usb 1-2"});
  Mcc1208Settings settings = bench_settings();
  settings.serial = "FFFFFFFF";
  CHECK(make_mcc1208(settings)->open().fault().code == "usb.missing");
  settings.serial = "01D0F1A2";
  const auto drive = make_mcc1208(settings);
  CHECK(drive->identify().fault().code == "drive.off");
  REQUIRE(drive->open().ok());
  REQUIRE(drive->open().ok());
  CHECK(make_mcc1208(bench_settings())->open().fault().code == "usb.busy");
  REQUIRE(drive->identify().ok());
  CHECK(sent(bench, 0x41).size() == 1);
  REQUIRE(drive->start(sine(0.1)).ok());
  CHECK(drive->identify().fault().code == "drive.running");
  CHECK(drive->start(sine(0.1)).fault().code == "drive.running");
  CHECK(probe_mcc1208().size() == 1);  // one that plays goes on
  wait_s(0.1);
  CHECK(drive->state().phase == DevicePhase::running);
  CHECK(drive->refill(DrivePeriod{1.0 / 50.0, sine(0.1).drive_a}).fault().code == "drive.unable");
}

TEST_CASE("stops from a watchdog while others start: no current when all is said") {
  Bench bench;
  const auto drive = make_mcc1208(bench_settings());
  REQUIRE(drive->open().ok());
  for (int i = 0; i < 6; ++i) {
    std::thread watchdog([&] {
      wait_s(0.004 * i);
      drive->stop();
    });
    const Status started = drive->start(sine(0.2, 1.0));
    watchdog.join();
    if (started) {
      drive->stop();
    } else {
      CHECK(started.fault().code == "drive.stopped");
    }
    CHECK(drive->state().phase == DevicePhase::ready);
    CHECK(at_rest(bench));
    CHECK_FALSE(enabled(bench));
  }
}

TEST_CASE("steered, it plays another length and phase without a gap, and says how late its edges are") {
  Bench bench;
  const auto drive = make_mcc1208(bench_settings());
  CHECK(drive->abilities().steers);
  REQUIRE(drive->open().ok());
  CHECK(drive->steer(1.0 / 60.0, 0.0).fault().code == "drive.off");
  REQUIRE(drive->start(sine(0.1)).ok());
  CHECK(drive->steer(1.0 / 59.0, 0.0).fault().code == "drive.unable");
  CHECK(drive->steer(1.0 / 60.0, NAN).fault().code == "drive.unable");
  wait_s(0.2);
  constexpr double period_s = 1.0 / 59.94;
  REQUIRE(drive->steer(period_s, 0.002).ok());
  const std::size_t steered_at = bench.scan_count();
  REQUIRE(until([&] { return bench.scan_count() > steered_at + 48000; }, 20.0));
  const DriveReport report = drive->report();
  const auto played = from_first_edge(bench.scans());
  drive->stop();
  CHECK(report.underruns == 0);
  CHECK(report.period_s == doctest::Approx(period_s).epsilon(1e-12));
  CHECK(report.edge_late_s >= 0.0);
  CHECK(report.edge_late_s < 1.0 / 24e3);
  std::vector<double> edges_s;
  for (std::size_t i = 1; i < played.size(); ++i) {
    CHECK(*played[i].scan == *played[i - 1].scan + 1);
    if (played[i].codes[1] > 2048 && played[i - 1].codes[1] < 2048) edges_s.push_back(played[i].time_s);
  }
  REQUIRE(edges_s.size() > 100);
  const double last_s = edges_s.back() - edges_s[edges_s.size() - 61];
  CHECK(last_s == doctest::Approx(60 * period_s).epsilon(5e-5));  // a scan in a second
  const double all_s = edges_s.back() - edges_s.front();
  const double lengths = all_s / period_s;
  // Before it, periods of 60 Hz; in it, 2 ms more.
  CHECK(std::abs(all_s - 0.002 - std::round(lengths) * period_s) < 0.001);
}

}  // namespace
}  // namespace focalstage
