#include "devices/mcc1208/drive.h"

#include <doctest/doctest.h>

#include "tests/devices/mcc1208/bench.h"

namespace focalstage {
namespace {

TEST_CASE("an underrun is found within 500 ms, named, counted, and ends at zero") {
  Bench bench;
  const auto drive = make_mcc1208(bench_settings());
  REQUIRE(drive->open().ok());
  REQUIRE(drive->start(sine(0.2, 1.0)).ok());
  wait_s(0.2);
  emulated::Misbehaviour how;
  how.starve = true;
  bench.device().misbehave(how);
  const auto found_s = until([&] { return drive->state().fault.has_value(); }, 2.0);
  REQUIRE(found_s);
  CHECK(*found_s < 0.5);
  MESSAGE("the underrun was found and at zero after ", 1e3 * *found_s, " ms, its FIFO of 43 ms included");
  CHECK(drive->state().fault->code == "drive.underrun");
  CHECK(drive->state().phase == DevicePhase::ready);
  CHECK(drive->report().underruns == 1);
  CHECK(at_rest(bench));
  CHECK_FALSE(enabled(bench));
  bench.device().misbehave({});
  bench.forget_outputs();
  REQUIRE(drive->start(sine(0.2)).ok());  // the stall is cleared
  CHECK_FALSE(drive->state().fault.has_value());
  REQUIRE(until([&] { return bench.scan_count() > 2000; }, 5.0));
}

TEST_CASE("unplugged it is lost, and open finds it again under another number") {
  Bench bench;
  const auto drive = make_mcc1208(bench_settings());
  REQUIRE(drive->open().ok());
  CHECK(drive->id().serial == "01D0F1A2");
  CHECK(drive->id().address == "usb 1-2");
  REQUIRE(drive->start(sine(0.2)).ok());
  wait_s(0.2);
  bench.device().unplug();
  const auto found_s = until([&] { return drive->state().phase == DevicePhase::lost; }, 2.0);
  REQUIRE(found_s);
  CHECK(*found_s < 0.5);
  CHECK(drive->state().fault->code == "usb.lost");
  CHECK_FALSE(drive->stop());
  CHECK_FALSE(drive->start(sine(0.2)).ok());
  CHECK(drive->open().fault().code == "usb.missing");
  bench.device().plug_in();
  bench.forget_outputs();
  REQUIRE(drive->open().ok());
  CHECK(drive->state().phase == DevicePhase::ready);
  REQUIRE(drive->start(sine(0.2)).ok());
  REQUIRE(until([&] { return bench.scan_count() > 2000; }, 5.0));
}

TEST_CASE("cut off at any byte it is lost, never stuck") {
  for (const std::uint64_t byte : {1ULL, 63ULL, 64ULL, 1600ULL, 1601ULL, 4097ULL, 30001ULL}) {
    CAPTURE(byte);
    Bench bench;
    emulated::Misbehaviour how;
    how.cut_at_byte = byte;
    bench.device().misbehave(how);
    const auto drive = make_mcc1208(bench_settings());
    REQUIRE(drive->open().ok());
    (void)drive->start(sine(0.2));
    CHECK(until([&] { return drive->state().phase == DevicePhase::lost; }, 2.0));
    const double start_s = monotonic_s();
    drive->close();
    CHECK(monotonic_s() - start_s < 0.5);
  }
}

TEST_CASE("cut off at any request of opening and starting it is a fault, never stuck") {
  for (std::uint64_t request = 0; request < 24; request += 3) {
    CAPTURE(request);
    Bench bench;
    emulated::Misbehaviour how;
    how.cut_at_request = request;
    bench.device().misbehave(how);
    const auto drive = make_mcc1208(bench_settings());
    const double start_s = monotonic_s();
    if (drive->open()) (void)drive->start(sine(0.2));
    CHECK(until([&] { return drive->state().phase == DevicePhase::lost; }, 2.0));
    CHECK(monotonic_s() - start_s < 3.0);
    CHECK(drive->state().fault.has_value());
  }
}

TEST_CASE("a device that answers nothing is lost within 500 ms, and asking it is over in time") {
  Bench bench;
  const auto drive = make_mcc1208(bench_settings());
  REQUIRE(drive->open().ok());
  REQUIRE(drive->start(sine(0.2)).ok());
  wait_s(0.2);
  emulated::Misbehaviour how;
  how.silent = true;
  bench.device().misbehave(how);
  const double start_s = monotonic_s();
  CHECK_FALSE(drive->stop());
  CHECK(monotonic_s() - start_s < 0.5);
  CHECK(drive->state().phase == DevicePhase::lost);
  CHECK(drive->state().fault->code == "usb.timeout");
  bench.device().misbehave({});
  REQUIRE(drive->open().ok());
  CHECK(at_rest(bench));
  bench.device().misbehave(how);
  const auto found_s = until([&] { return drive->state().phase == DevicePhase::lost; }, 2.0);
  REQUIRE(found_s);
  CHECK(*found_s < 0.5);
}

TEST_CASE("a transfer that ends short stops it: what follows would be out of step") {
  Bench bench;
  const auto drive = make_mcc1208(bench_settings());
  REQUIRE(drive->open().ok());
  REQUIRE(drive->start(sine(0.2)).ok());
  emulated::Misbehaviour how;
  how.short_write = 30;
  bench.device().misbehave(how);
  REQUIRE(until([&] { return drive->state().fault.has_value(); }, 2.0));
  CHECK(drive->state().fault->code == "usb.short");
  CHECK(at_rest(bench));
}

TEST_CASE("one that takes no more samples is said first, while it still plays, and then ended") {
  Bench bench;
  const auto drive = make_mcc1208(bench_settings());
  REQUIRE(drive->open().ok());
  REQUIRE(drive->start(sine(0.2)).ok());
  wait_s(0.2);
  bench.stop_time();
  const auto found_s = until([&] { return drive->state().fault.has_value(); }, 2.0);
  REQUIRE(found_s);
  CHECK(*found_s < 0.5);
  CHECK(drive->state().fault->code == "drive.stalled");
  CHECK(drive->state().phase == DevicePhase::running);
  CHECK(enabled(bench));
  const auto ended_s = until([&] { return drive->state().phase == DevicePhase::ready; }, 2.0);
  REQUIRE(ended_s);
  CHECK(*ended_s < 0.2);
  CHECK(drive->state().fault->code == "drive.stalled");
  CHECK(at_rest(bench));
}

TEST_CASE("a status that says underrun is believed while samples still flow") {
  Bench bench;
  const auto drive = make_mcc1208(bench_settings());
  REQUIRE(drive->open().ok());
  REQUIRE(drive->start(sine(0.2)).ok());
  emulated::Misbehaviour how;
  how.status_bits = 1 << 4;
  bench.device().misbehave(how);
  const auto found_s = until([&] { return drive->state().fault.has_value(); }, 2.0);
  REQUIRE(found_s);
  CHECK(*found_s < 0.5);
  CHECK(drive->state().fault->code == "drive.underrun");
  CHECK(at_rest(bench));
}

TEST_CASE("a request that is refused is a fault of the call") {
  for (const std::uint8_t request : {0x1a, 0x1c, 0x44}) {
    CAPTURE(static_cast<int>(request));
    Bench bench;
    const auto drive = make_mcc1208(bench_settings());
    REQUIRE(drive->open().ok());
    emulated::Misbehaviour how;
    how.stalled = {request};
    bench.device().misbehave(how);
    const Status started = drive->start(sine(0.2));
    REQUIRE_FALSE(started.ok());
    CHECK(started.fault().code == "usb.stall");
    CHECK(at_rest(bench));
    CHECK_FALSE(enabled(bench));
  }
}

TEST_CASE("slow answers within the deadline are no fault") {
  Bench bench;
  emulated::Misbehaviour how;
  how.delay_s = 0.01;
  bench.device().misbehave(how);
  const auto drive = make_mcc1208(bench_settings());
  REQUIRE(drive->open().ok());
  REQUIRE(drive->start(sine(0.2)).ok());
  wait_s(0.5);
  CHECK(drive->state().phase == DevicePhase::running);
  CHECK_FALSE(drive->state().fault.has_value());
}

}  // namespace
}  // namespace focalstage
