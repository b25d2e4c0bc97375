#include "devices/optotune/packets.h"

#include <random>
#include <sstream>

#include <doctest/doctest.h>

#include "tests/devices/optotune/emulator/lens_driver.h"

namespace focalstage {
namespace {

OptotuneBytes bytes_of(const std::string& hexadecimal) {
  std::istringstream words(hexadecimal);
  OptotuneBytes bytes;
  for (std::string word; words >> word;) bytes.push_back(static_cast<std::uint8_t>(std::stoi(word, nullptr, 16)));
  return bytes;
}

OptotuneBytes good(const std::string& hexadecimal, std::size_t answer) {
  const auto read = read_optotune(bytes_of(hexadecimal), answer);
  CHECK(read.reading == OptotuneReading::good);
  return read.payload;
}

TEST_CASE("the checksum is CRC-16/ARC, and the emulator's own agrees") {
  const std::string digits = "123456789";
  CHECK(optotune_crc(OptotuneBytes(digits.begin(), digits.end())) == 0xbb3d);
  CHECK(optotune_crc(bytes_of("50 77 44 41 07 D0 00 00")) == 0xfd31);  // the manual's example
  std::mt19937 chance(4);
  for (int i = 0; i < 1000; ++i) {
    OptotuneBytes bytes(chance() % 20);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(chance());
    CHECK(optotune_crc(bytes) == optotune_emulator::checksum(bytes));
  }
}

TEST_CASE("commands are the published bytes") {
  CHECK(optotune_ask_firmware_type().bytes == bytes_of("48 00 36"));
  CHECK(optotune_ask_version().bytes == bytes_of("56 80 3E"));
  CHECK(optotune_ask_lens_serial().bytes == bytes_of("58 01 FA"));
  CHECK(optotune_ask_device_id().bytes == bytes_of("49 52 00 00 00 00 00 00 00 00 37 98"));
  CHECK(optotune_ask_mode().bytes == bytes_of("4D 4D 41 65 77"));
  CHECK(optotune_ask_temperature().bytes == bytes_of("54 43 41 B0 D0"));
  CHECK(optotune_ask_status().bytes == bytes_of("53 72 BC D5"));
  CHECK(optotune_ask_most_current().bytes == bytes_of("43 72 4D 41 00 00 71 80"));
  CHECK(optotune_ask_current().bytes == bytes_of("41 72 00 00 B4 27"));
  CHECK(optotune_set_most_current(25000).bytes == bytes_of("43 77 4D 41 61 A8 95 AE"));
  CHECK(optotune_set_most_current(29284).bytes == bytes_of("43 77 4D 41 72 64 98 CB"));
  const auto mode = [](OptotuneMode wanted) { return optotune_set_mode(wanted)->bytes; };
  CHECK(mode(OptotuneMode::current) == bytes_of("4D 77 44 41 54 46"));
  CHECK(mode(OptotuneMode::sine) == bytes_of("4D 77 53 41 5B B6"));
  CHECK(mode(OptotuneMode::square) == bytes_of("4D 77 51 41 5A D6"));
  CHECK(mode(OptotuneMode::triangle) == bytes_of("4D 77 54 41 59 86"));
  CHECK(mode(OptotuneMode::focal_power) == bytes_of("4D 77 43 41 56 76"));
  CHECK(mode(OptotuneMode::analogue) == bytes_of("4D 77 41 41 57 16"));
  CHECK_FALSE(optotune_set_mode(OptotuneMode::position).has_value());
  CHECK(optotune_set_current(0).bytes == bytes_of("41 77 00 00 A4 26"));
  CHECK(optotune_set_current(4095).bytes == bytes_of("41 77 0F FF E1 96"));
  CHECK(optotune_set_current(-4095).bytes == bytes_of("41 77 F0 01 21 E6"));
  CHECK(optotune_set_current(2047).bytes == bytes_of("41 77 07 FF E6 56"));
  CHECK(optotune_set_current(-2047).bytes == bytes_of("41 77 F8 01 26 26"));
  CHECK(optotune_set_current(optotune_counts(0.05, 0.29284)).bytes == bytes_of("41 77 02 BB E5 35"));
}

TEST_CASE("answers read as what the sheet says they mean") {
  CHECK(optotune_celsius(*optotune_number(good("54 43 41 01 90 75 A0 0D 0A", 5))) == 25.0);
  CHECK(good("4D 4D 41 02 36 EA 0D 0A", 4)[3] == static_cast<int>(OptotuneMode::sine));
  CHECK(optotune_number(good("43 4D 41 72 64 27 FC 0D 0A", 5)) == 29284);
  CHECK(optotune_number(good("41 02 BB 11 07 0D 0A", 3)) == 699);
  CHECK(good("4D 44 41 63 27 0D 0A", 3) == bytes_of("4D 44 41"));
  CHECK(good("4D 53 41 6C D7 0D 0A", 3) == bytes_of("4D 53 41"));
  CHECK(optotune_status(good("53 00 00 00 00 84 0C 0D 0A", 5)) == OptotuneStatus{});
  CHECK(optotune_version(good("56 01 0C 00 F0 03 20 26 CE 0D 0A", 7)) == "1.12.240.800");
}

TEST_CASE("refusals are told by their number, raw or as a character") {
  const char* golden[] = {"45 01 F3 50 0D 0A", "45 02 B3 51 0D 0A", "45 03 72 91 0D 0A", "45 04 33 53 0D 0A"};
  for (int i = 0; i < 4; ++i) {
    for (const std::size_t answer : {0U, 3U, 9U}) {
      const auto read = read_optotune(bytes_of(golden[i]), answer);
      CHECK(read.reading == OptotuneReading::refused);
      CHECK(read.error == i + 1);
    }
  }
  OptotuneBytes digit{'E', '3'};
  const auto crc = optotune_crc(digit);
  for (const int byte : {crc & 0xff, crc >> 8, 0x0d, 0x0a}) digit.push_back(static_cast<std::uint8_t>(byte));
  CHECK(read_optotune(digit, 5).error == 3);
}

TEST_CASE("a payload with a line end within is not cut there, and none is read before it is whole") {
  OptotuneBytes bytes{'T', 'C', 'A', 0x0d, 0x0a};
  const auto crc = optotune_crc(bytes);
  for (const int byte : {crc & 0xff, crc >> 8, 0x0d, 0x0a}) bytes.push_back(static_cast<std::uint8_t>(byte));
  for (std::size_t count = 0; count < bytes.size(); ++count) {
    CHECK(read_optotune(std::span(bytes).first(count), 5).reading == OptotuneReading::more);
  }
  const auto read = read_optotune(bytes, 5);
  CHECK(read.reading == OptotuneReading::good);
  CHECK(optotune_number(read.payload) == 0x0d0a);
}

TEST_CASE("any wrong bit is seen") {
  const OptotuneBytes right = bytes_of("54 43 41 01 90 75 A0 0D 0A");
  for (std::size_t bit = 0; bit < 8 * right.size(); ++bit) {
    OptotuneBytes wrong = right;
    wrong[bit / 8] = static_cast<std::uint8_t>(wrong[bit / 8] ^ 1U << bit % 8);
    CHECK(read_optotune(wrong, 5).reading != OptotuneReading::good);
  }
}

TEST_CASE("currents and counts go both ways, towards zero and never beyond full scale") {
  CHECK(optotune_counts(0.25, 0.25) == 4095);
  CHECK(optotune_counts(-0.25, 0.25) == -4095);
  CHECK(optotune_counts(1.0, 0.25) == 4095);
  CHECK(optotune_counts(-1e9, 0.25) == -4095);
  CHECK(optotune_counts(0.1, 0.0) == 0);
  CHECK(optotune_counts(0.0 / 0.0, 0.25) == 0);
  for (int counts = -4095; counts <= 4095; counts += 91) {
    CHECK(std::abs(optotune_counts(optotune_amperes(counts, 0.25), 0.25) - counts) <= 1);
  }
}

TEST_CASE("random bytes are read within bounds") {
  std::mt19937 chance(2018);
  for (int i = 0; i < 50000; ++i) {
    OptotuneBytes bytes(chance() % 16);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(chance());
    if (i % 4 == 0 && !bytes.empty()) bytes[0] = 'E';
    const std::size_t answer = chance() % 11;
    const auto read = read_optotune(bytes, answer);
    if (read.reading == OptotuneReading::good) CHECK(read.payload.size() == answer);
    (void)optotune_number(bytes);
    (void)optotune_version(bytes);
    (void)optotune_status(bytes);
  }
}

}  // namespace
}  // namespace focalstage
