#include "devices/serial/serial_port.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <pty.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <numeric>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "devices/roles/clock.h"

using namespace focalstage;

namespace {

/// A pty whose other side is the test's.
struct Pty {
  Pty() {
    int slave = -1;
    std::array<char, 128> name{};
    REQUIRE(::openpty(&master, &slave, name.data(), nullptr, nullptr) == 0);
    path = name.data();
    ::close(slave);
  }
  ~Pty() { unplug(); }
  Pty(const Pty&) = delete;
  Pty& operator=(const Pty&) = delete;

  void unplug() {
    if (master >= 0) ::close(master);
    master = -1;
  }
  void say(const std::string& bytes) const {
    REQUIRE(::write(master, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
  }
  std::string hear(std::size_t count) const {
    std::string heard;
    std::array<char, 512> some{};
    while (heard.size() < count) {
      const ssize_t got = ::read(master, some.data(), some.size());
      if (got <= 0) break;
      heard.append(some.data(), static_cast<std::size_t>(got));
    }
    return heard;
  }

  int master = -1;
  std::string path;
};

SerialPort opened(const std::string& path) {
  auto port = SerialPort::open(path);
  REQUIRE(port.ok());
  return std::move(port).value();
}

std::string read_within(SerialPort& port, double seconds) {
  std::array<std::uint8_t, 1024> buffer{};
  const auto got = port.read_some(buffer, monotonic_s() + seconds);
  REQUIRE(got.ok());
  return {buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(*got)};
}

std::string every_byte() {
  std::string all(256, '\0');
  std::iota(all.begin(), all.end(), '\0');
  return all;
}

}  // namespace

TEST_CASE("every byte goes through as it is, both ways") {
  const Pty pty;
  SerialPort port = opened(pty.path);
  CHECK(port.path() == pty.path);
  REQUIRE(port.write_all(every_byte(), monotonic_s() + 1.0).ok());
  CHECK(pty.hear(256) == every_byte());
  pty.say(every_byte());
  std::string came;
  while (came.size() < 256) came += read_within(port, 1.0);
  CHECK(came == every_byte());
}

TEST_CASE("reading waits until its deadline and no longer, and takes what is there when that is over") {
  const Pty pty;
  SerialPort port = opened(pty.path);
  const double begin_s = monotonic_s();
  CHECK(read_within(port, 0.05).empty());
  CHECK(monotonic_s() - begin_s >= 0.05);
  CHECK(monotonic_s() - begin_s < 0.5);
  pty.say("late");
  CHECK(read_within(port, -1.0) == "late");
  CHECK(read_within(port, -1.0).empty());
  std::jthread speaker([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    pty.say("x");
  });
  CHECK(read_within(port, 5.0) == "x");
  CHECK(monotonic_s() - begin_s < 2.0);
}

TEST_CASE("writing to who does not read ends with the deadline") {
  const Pty pty;
  SerialPort port = opened(pty.path);
  const std::string much(1 << 20, 'm');
  const double begin_s = monotonic_s();
  const Status sent = port.write_all(much, begin_s + 0.05);
  REQUIRE_FALSE(sent.ok());
  CHECK(sent.fault().code == "serial.timeout");
  CHECK(sent.fault().where == pty.path);
  CHECK(monotonic_s() - begin_s < 0.5);
}

TEST_CASE("a port that was unplugged is gone, at once, for reading and for writing") {
  Pty pty;
  SerialPort port = opened(pty.path);
  std::array<std::uint8_t, 16> buffer{};
  SUBCASE("while nobody waits") { pty.unplug(); }
  SUBCASE("while a reader waits") {
    std::jthread puller([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      pty.unplug();
    });
    const double begin_s = monotonic_s();
    CHECK(port.read_some(buffer, begin_s + 5.0).ok() == false);
    CHECK(monotonic_s() - begin_s < 1.0);
  }
  const auto got = port.read_some(buffer, monotonic_s() + 5.0);
  REQUIRE_FALSE(got.ok());
  CHECK(got.fault().code == "serial.gone");
  CHECK(got.fault().where == pty.path);
  CHECK_FALSE(got.fault().remedy.empty());
  const Status sent = port.write_all("x", monotonic_s() + 5.0);
  REQUIRE_FALSE(sent.ok());
  CHECK(sent.fault().code == "serial.gone");
}

TEST_CASE("a port is one owner's, until that one lets go of it") {
  const Pty pty;
  {
    const SerialPort port = opened(pty.path);
    const auto again = SerialPort::open(pty.path);
    REQUIRE_FALSE(again.ok());
    CHECK(again.fault().code == "serial.busy");
  }
  SerialPort first = opened(pty.path);
  SerialPort second = std::move(first);
  pty.say("moved");
  CHECK(read_within(second, 1.0) == "moved");
  second.discard_input();
  pty.say("stale");
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  second.discard_input();
  CHECK(read_within(second, 0.01).empty());
}

TEST_CASE("what is no serial port is refused and named") {
  const auto nothing = SerialPort::open("/nowhere/ttyACM9");
  REQUIRE_FALSE(nothing.ok());
  CHECK(nothing.fault().code == "serial.open");
  CHECK(nothing.fault().where == "/nowhere/ttyACM9");
  CHECK_FALSE(nothing.fault().remedy.empty());
  const auto file = SerialPort::open("/dev/null");
  REQUIRE_FALSE(file.ok());
  CHECK(file.fault().code == "serial.open");
  const Pty pty;
  const auto odd = SerialPort::open(pty.path, 115201);
  REQUIRE_FALSE(odd.ok());
  CHECK(odd.fault().code == "serial.baud");
}
