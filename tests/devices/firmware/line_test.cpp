#include "devices/firmware/line.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <string_view>

#include "devices/firmware/crc16.h"

namespace {

/// By the definition, bit for bit.
std::uint16_t crc_by_bits(std::string_view text) {
  unsigned crc = 0xFFFF;
  for (const char byte : text) {
    crc ^= static_cast<unsigned>(static_cast<unsigned char>(byte)) << 8;
    for (int bit = 0; bit < 8; ++bit)
      crc = (crc & 0x8000U) != 0 ? ((crc << 1) ^ 0x1021U) & 0xFFFFU : (crc << 1) & 0xFFFFU;
  }
  return static_cast<std::uint16_t>(crc);
}

std::uint16_t crc(std::string_view text) {
  std::uint16_t sum = FS_CRC16_START;
  for (const char byte : text) sum = fs_crc16(sum, static_cast<std::uint8_t>(byte));
  return sum;
}

/// The event of the last byte.
fs_line_event push(fs_line_reader& reader, std::string_view bytes) {
  fs_line_event event = FS_LINE_NONE;
  for (const char byte : bytes) event = fs_line_push(&reader, byte);
  return event;
}

std::string write(std::string_view text) {
  fs_line_writer writer{};
  fs_line_text(&writer, std::string(text).c_str());
  return {writer.text, fs_line_end(&writer)};
}

}  // namespace

TEST_CASE("the checksum is CRC-16/CCITT-FALSE") {
  CHECK(crc("123456789") == 0x29B1);
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    std::string text(random() % 80, '\0');
    for (char& byte : text) byte = static_cast<char>(random());
    CHECK(crc(text) == crc_by_bits(text));
  }
}

TEST_CASE("a line comes back as it was written; damaged by any one byte it does not") {
  const std::string line = write("12 TRIG 3 1234");
  fs_line_reader reader{};
  REQUIRE(push(reader, line) == FS_LINE_OK);
  CHECK(std::string(reader.text) == "12 TRIG 3 1234");
  for (std::size_t at = 0; at + 1 < line.size(); ++at) {
    for (int flip = 1; flip < 256; ++flip) {
      std::string damaged = line;
      damaged[at] = static_cast<char>(damaged[at] ^ flip);
      fs_line_reader fresh{};
      CHECK(push(fresh, damaged) != FS_LINE_OK);
      fs_line_push(&fresh, '\n');
      CHECK(push(fresh, line) == FS_LINE_OK);
    }
  }
}

TEST_CASE("lines without a checksum, empty and too long ones are bad, and the next is not") {
  const std::string good = write("1 PING");
  for (const std::string& bad : {std::string("1 PING\n"), std::string("\n"), std::string("*FFFF\n"),
                                 std::string(300, 'x') + '\n', write(std::string(57, 'y')) + "z\n"}) {
    CAPTURE(bad);
    fs_line_reader reader{};
    CHECK(push(reader, bad) == FS_LINE_BAD);
    CHECK(push(reader, good) == FS_LINE_OK);
  }
  CHECK(write(std::string(58, 'y')).size() == FS_LINE_MAX);
  CHECK(write(std::string(59, 'y')).empty());
}

TEST_CASE("the longest line that can be written can be read") {
  fs_line_reader reader{};
  CHECK(push(reader, write(std::string(58, 'y'))) == FS_LINE_OK);
}

TEST_CASE("random bytes never make a line and never write out of bounds") {
  std::mt19937 random(2);
  fs_line_reader reader{};
  int lines = 0;
  for (int i = 0; i < 2'000'000; ++i) {
    const unsigned pick = random();
    const char byte = pick % 32 == 0 ? '\n' : pick % 16 == 1 ? '*' : static_cast<char>(pick >> 8);
    lines += fs_line_push(&reader, byte) == FS_LINE_OK ? 1 : 0;
    REQUIRE(reader.length < FS_LINE_MAX);
  }
  CHECK(lines == 0);
}

TEST_CASE("numbers are decimal, whole words, 0 to 65535") {
  const auto number = [](const char* text) -> std::optional<int> {
    std::uint16_t value = 0;
    return fs_take_number(&text, &value) ? std::optional<int>(value) : std::nullopt;
  };
  CHECK(number("0") == 0);
  CHECK(number("65535 9") == 65535);
  for (const char* bad : {"", " 1", "65536", "99999", "000001", "-1", "+1", "1x", "x"}) {
    CAPTURE(bad);
    CHECK_FALSE(number(bad));
  }
  fs_line_writer writer{};
  fs_line_number(&writer, 4294967295U);
  fs_line_number(&writer, 0);
  CHECK(std::string(writer.text, writer.length) == "42949672950");
}
