#include "tests/devices/uno/emulator/emulator.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "devices/roles/clock.h"
#include "devices/serial/serial_port.h"
#include "tests/devices/uno/emulator/line_sum.h"

using namespace focalstage;
using namespace focalstage::uno_emulator;

namespace {

constexpr Cycle ms = 16'000;

Options with_firmware() {
  Options options;
  options.firmware_elf = FOCALSTAGE_FIRMWARE_ELF;
  return options;
}

SerialPort opened(const std::string& path) {
  auto port = SerialPort::open(path);
  REQUIRE(port.ok());
  return std::move(port).value();
}

void say(SerialPort& host, const std::string& body) {
  REQUIRE(host.write_all(with_sum(body) + "\n", monotonic_s() + 1.0).ok());
}

std::string heard(SerialPort& host) {
  std::array<std::uint8_t, 4096> buffer{};
  const auto got = host.read_some(buffer, monotonic_s() + 0.05);
  return got ? std::string(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(*got)) : "gone";
}

std::string line(const std::string& body) { return with_sum(body) + "\n"; }

/// The same lines and edges at the same cycles, however the way there is cut.
std::vector<Cycle> rises_of(Cycle stride) {
  UnoEmulator uno(with_firmware());
  SerialPort host = opened(uno.path());
  for (Cycle at = 30 * ms; at < 400 * ms; at += 266'667) uno.chip().edge_at(at);
  uno.chip().run_until(150 * ms);
  for (const char* body : {"1 TABLE 33333 100", "2 TRIG 0 4000", "3 TRIG 1 20000", "4 COMMIT 2", "5 ARM"}) {
    say(host, body);
  }
  for (Cycle at = 150 * ms; at < 400 * ms;) uno.run_until(at += stride);
  std::vector<Cycle> rises;
  for (const PinChange& change : uno.chip().trigger) {
    if (change.high) rises.push_back(change.at);
  }
  return rises;
}

}  // namespace

TEST_CASE("edges come at the cycles that were said, in any order, and a run ends where it should, asleep or not") {
  Chip chip(FOCALSTAGE_FIRMWARE_ELF);
  chip.run_until(5 * ms);
  for (const Cycle at : {40 * ms + 7, 21 * ms + 3, 60 * ms, 21 * ms + 2000}) chip.edge_at(at);
  for (Cycle at = 5 * ms + 1; at < 70 * ms; at += 12'347) {
    chip.run_until(at);
    CHECK(chip.now() >= at);
    CHECK(chip.now() <= at + 4);
  }
  const std::vector<Cycle> wanted{21 * ms + 3, 21 * ms + 2000, 40 * ms + 7, 60 * ms};
  REQUIRE(chip.edges.size() == wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    CHECK(chip.edges[i] >= wanted[i]);
    CHECK(chip.edges[i] <= wanted[i] + 4);
  }
}

TEST_CASE("a chip that falls asleep in the cycle at which it is to stop stops there") {
  Chip chip(FOCALSTAGE_FIRMWARE_ELF);
  Cycle most = 0;
  for (Cycle at = 20 * ms; at < 24 * ms; ++at) {  // each cycle, so also those; Timer 0 wakes it every 1.024 ms
    chip.run_until(at);
    most = std::max(most, chip.now() - at);
  }
  chip.reset();
  for (Cycle at = 24 * ms; at < 28 * ms; ++at) {
    chip.run_until(at);
    most = std::max(most, chip.now() - at);
  }
  CHECK(most <= 4);
}

TEST_CASE("the same edges and bytes give the same pins, however the run is cut") {
  const std::vector<Cycle> rises = rises_of(8'000);
  CHECK(rises.size() >= 20);
  const std::vector<Cycle> again = rises_of(8'000);
  CHECK(rises == again);
  // Cut elsewhere, the answers to the pump come elsewhere, but nobody waits for them here.
  CHECK(rises_of(50'001).size() == rises.size());
}

TEST_CASE("unplugged the port is gone; plugged in it has another name, and the link follows") {
  UnoEmulator uno(with_firmware());
  const std::string link = (std::filesystem::temp_directory_path() / "focalstage-uno-link").string();
  uno.set_link(link);
  uno.run_until(10 * ms);
  SerialPort host = opened(link);
  uno.run_until(11 * ms);
  say(host, "9 PING");
  uno.run_until(20 * ms);
  CHECK(heard(host) == line("9 OK"));
  const std::string before = uno.path();
  uno.unplug();
  CHECK(heard(host) == "gone");
  CHECK_FALSE(std::filesystem::exists(link));
  uno.plug_in();
  CHECK(uno.path() != before);
  SerialPort again = opened(link);
  uno.run_until(40 * ms);
  CHECK(heard(again).rfind("! BOOT focalstage-uno 1", 0) == 0);
}

TEST_CASE("opening resets, where that is wanted, and the boot loader is deaf") {
  Options options = with_firmware();
  options.resets_when_opened = true;
  options.boot_s = 0.05;
  UnoEmulator uno(options);
  uno.run_until(10 * ms);
  SerialPort host = opened(uno.path());
  uno.run_until(11 * ms);
  say(host, "9 PING");
  uno.run_until(80 * ms);
  const std::string said = heard(host);
  CHECK(said.rfind("! BOOT", 0) == 0);
  CHECK(said.find("9 OK") == std::string::npos);
}

TEST_CASE("the line does wrong what it is told to, and nothing else") {
  Line way;
  const auto through = [&](const Misbehaviour& how) {
    way.misbehave(how);
    way.clear();
    std::string out;
    for (const char* body : {"1 OK", "2 OK 5", "3 ERR 4", "4 OK"}) way.say(line(body), 0);
    return way.arrived(ms);
  };
  const std::string all = line("1 OK") + line("2 OK 5") + line("3 ERR 4") + line("4 OK");
  CHECK(through({}) == all);
  CHECK(through({.silent = true}).empty());
  CHECK(through({.lose_every = 2}) == line("1 OK") + line("3 ERR 4"));
  CHECK(through({.refuse = true}) == line("1 ERR 3") + line("2 ERR 3") + line("3 ERR 4") + line("4 ERR 3"));
  CHECK(through({.wrong_number_every = 3}) == line("1 OK") + line("2 OK 5") + line("103 ERR 4") + line("4 OK"));
  const std::string damaged = through({.damage_every = 4});
  CHECK(damaged != all);
  CHECK(damaged.rfind(line("1 OK") + line("2 OK 5") + line("3 ERR 4"), 0) == 0);
  CHECK(through({.stale = true}).rfind(line("1 OK") + line("1 OK") + line("2 OK 5"), 0) == 0);
  CHECK(through({.dribble = true}) == "1");
  CHECK(through({.delay_s = 0.01}).empty());
  CHECK(way.arrived(200 * ms) == all);
  way.misbehave({.deaf = true});
  CHECK(way.told("1 PING\n").empty());
  way.misbehave({.damage_requests_every = 2});
  CHECK(way.told("ab\ncd\nef\n") == "ab\nc~\nef\n");
}

TEST_CASE("the port is gone after as many bytes as were said") {
  for (const std::size_t bytes : {0, 1, 7, 30, 31}) {
    CAPTURE(bytes);
    UnoEmulator uno(with_firmware());
    uno.misbehave({.unplug_after = bytes});
    SerialPort host = opened(uno.path());
    uno.run_until(20 * ms);
    const bool breaks = bytes < 31;  // the banner has so many
    CHECK(uno.plugged_in() != breaks);
  }
}
