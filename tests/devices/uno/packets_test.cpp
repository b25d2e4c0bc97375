#include "devices/uno/packets.h"

#include <doctest/doctest.h>

#include <optional>
#include <random>
#include <string>

#include "devices/firmware/line.h"

using namespace focalstage;

namespace {

/// As the board itself ends a line.
std::string board_says(const std::string& body) {
  fs_line_writer writer{};
  fs_line_text(&writer, body.c_str());
  const std::uint8_t length = fs_line_end(&writer);
  return length == 0 ? std::string() : std::string(writer.text, length - 1U);
}

}  // namespace

TEST_CASE("the board reads every request, to the longest, and longer ones are none") {
  CHECK(uno::crc16("123456789") == 0x29B1);
  for (const int number : {0, 9, 10, 255}) {
    for (std::size_t length = 1; length < 70; ++length) {
      const std::string command(length, 'x');
      const auto line = uno::request(static_cast<std::uint8_t>(number), command);
      const std::string body = std::to_string(number) + " " + command;
      REQUIRE(line.has_value() == (body.size() <= 58));
      if (!line) continue;
      fs_line_reader reader{};
      fs_line_event event = FS_LINE_NONE;
      for (const char byte : *line) event = fs_line_push(&reader, byte);
      CHECK(event == FS_LINE_OK);
      CHECK(std::string(reader.text) == body);
    }
  }
  CHECK_FALSE(uno::request(1, "PING\n"));
  CHECK_FALSE(uno::request(1, "\xC3\xA4"));
}

TEST_CASE("what the board says is understood") {
  using uno::ReplyKind;
  CHECK(uno::decode(board_says("7 OK")) == uno::Reply{ReplyKind::ok, 7, 0, 0, ""});
  CHECK(uno::decode(board_says("255 OK 1 2 3")) == uno::Reply{ReplyKind::ok, 255, 0, 0, "1 2 3"});
  CHECK(uno::decode(board_says("0 ERR 4")) == uno::Reply{ReplyKind::error, 0, 4, 0, ""});
  CHECK(uno::decode(board_says("! ERR 2")) == uno::Reply{ReplyKind::error, {}, 2, 0, ""});
  CHECK(uno::decode(board_says("! DARK 3")) == uno::Reply{ReplyKind::dark, {}, 3, 0, ""});
  CHECK(uno::decode(board_says("! BOOT focalstage-uno 1 8")) == uno::Reply{ReplyKind::boot, {}, 8, 1, ""});
}

TEST_CASE("what it cannot have said is damaged") {
  for (const char* body :
       {"", "7", "7 ", "256 OK", "-1 OK", "x OK", "7 OKAY", "7 ERR", "7 ERR x", "7 ERR 1 2", "! DARK", "! DARK 70000",
        "! BOOT other 1 8", "! BOOT focalstage-uno 1", "! BOOT focalstage-uno x 8", "! OK"}) {
    CAPTURE(body);
    CHECK(uno::decode(board_says(body)).kind == uno::ReplyKind::damaged);
  }
  CHECK(uno::decode("7 OK").kind == uno::ReplyKind::damaged);
  CHECK(uno::decode("7 OK*0000").kind == uno::ReplyKind::damaged);
}

TEST_CASE("status and name") {
  const auto status = uno::decode_status("2 0 3 33333 812 1");
  REQUIRE(status);
  CHECK(status->state == uno::StatusLine::State::running);
  CHECK(status->tables == 3);
  CHECK(status->period_s == doctest::Approx(0.0166665));
  CHECK(status->edges == 812);
  CHECK(status->bad_lines == 1);
  for (const char* bad :
       {"", "2 0 3 33333 812", "2 0 3 33333 812 1 9", "3 0 3 33333 812 1", "2 0 3 -1 812 1", "2  3 33333 812 1"}) {
    CAPTURE(bad);
    CHECK_FALSE(uno::decode_status(bad));
  }
  CHECK(uno::decode_hello("focalstage-uno 1 8") == 1U);
  CHECK_FALSE(uno::decode_hello("something 1 8"));
  CHECK_FALSE(uno::decode_hello("focalstage-uno one 8"));
}

TEST_CASE("the lens drive's edge, as LENS tells it") {
  const auto lens = uno::decode_lens("12582 65535");
  REQUIRE(lens);
  CHECK(lens->after_s == doctest::Approx(0.006291));
  CHECK(lens->edges == 65535);
  for (const char* bad : {"", "1", "1 2 3", "1 x", "-1 2", "65536 1", "1  2"}) {
    CAPTURE(bad);
    CHECK_FALSE(uno::decode_lens(bad));
  }
}

TEST_CASE("any one damaged byte is noticed, and random bytes are never an answer nor the end of reading") {
  const std::string line = board_says("12 OK 2 0 3 33333 812 1");
  for (std::size_t at = 0; at < line.size(); ++at) {
    for (int flip = 1; flip < 256; ++flip) {
      std::string damaged = line;
      damaged[at] = static_cast<char>(damaged[at] ^ flip);
      CHECK(uno::decode(damaged).kind == uno::ReplyKind::damaged);
    }
  }
  std::mt19937 random(4);
  uno::ReplyReader reader;
  int lines = 0;
  for (int i = 0; i < 500'000; ++i) {
    const unsigned pick = random();
    const std::optional<uno::Reply> reply = reader.push(pick % 32 == 0 ? '\n' : static_cast<char>(pick >> 8));
    if (!reply) continue;
    ++lines;
    REQUIRE(reply->kind == uno::ReplyKind::damaged);
  }
  CHECK(lines > 10'000);
  reader.push('\n');
  for (const char byte : line) CHECK_FALSE(reader.push(byte));
  CHECK(reader.push('\n')->kind == uno::ReplyKind::ok);
}
