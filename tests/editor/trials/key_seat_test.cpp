#include "editor/trials/key_seat.h"

#include <unistd.h>

#include <doctest/doctest.h>

#include "editor/trials/trial_words.h"

using namespace focalstage;

namespace {

const StudyPointer pointer{0.3, 0.5, 0.001};

/// What is confirmed after these bytes; every byte a key of the entry.
Result<double> typed(PointerEntry entry, const std::string& bytes) {
  KeyDecoder decoder;
  for (const char byte : bytes) (void)entry.take(decoder.take(byte));
  return entry.confirmed();
}

}  // namespace

TEST_CASE("arrows and page keys move by steps and stop at the ends") {
  const PointerEntry entry(pointer, 0.4);
  CHECK(*typed(entry, "\x1b[A") == doctest::Approx(0.401));
  CHECK(*typed(entry, "\x1b[C\x1bOA") == doctest::Approx(0.402));
  CHECK(*typed(entry, "\x1b[B\x1b[D") == doctest::Approx(0.398));
  CHECK(*typed(entry, "\x1b[5~") == doctest::Approx(0.41));
  CHECK(*typed(entry, "\x1b[6~\x1b[A") == doctest::Approx(0.391));
  std::string far;
  for (int k = 0; k < 30; ++k) far += "\x1b[5~";
  CHECK(*typed(entry, far) == doctest::Approx(0.5));
}

TEST_CASE("digits type a reading, backspace takes one back, an arrow forgets what was typed") {
  const PointerEntry entry(pointer, 0.4);
  CHECK(*typed(entry, "412") == doctest::Approx(0.412));
  CHECK(*typed(entry, "412.5") == doctest::Approx(0.4125));
  CHECK(*typed(entry,
               "413\x7f"
               "2") == doctest::Approx(0.412));
  CHECK(*typed(entry, "999\x1b[A") == doctest::Approx(0.401));
  CHECK(typed(entry, "999").fault().message.find("from 300 to 500 mm") != std::string::npos);
  CHECK(typed(entry, "4.1.2").fault().code == "trials.reading");
  CHECK(typed(entry, "").fault().message.find("where it was put") != std::string::npos);
  CHECK(typed(entry, "\x1b[Z\x1b[1;5P").fault().message.find("where it was put") != std::string::npos);
}

TEST_CASE("other keys come through whole") {
  KeyDecoder decoder;
  CHECK(decoder.take('g').character == 'g');
  CHECK(decoder.take('\r').key == SeatKey::enter);
  CHECK(decoder.take('\x1b').key == SeatKey::none);
  CHECK(decoder.take('[').key == SeatKey::none);
  CHECK(decoder.take('H').key == SeatKey::none);  // home: no meaning here
  CHECK(decoder.take('q').character == 'q');
}

TEST_CASE("readings in words") {
  CHECK(*reading_from(" 412.5 mm ", pointer) == doctest::Approx(0.4125));
  for (const char* bad : {"", " ", "abc", "412 cm", "4e400", "nan", "-412", "412 413", "0.412"}) {
    CAPTURE(bad);
    CHECK(reading_from(bad, pointer).fault().code == "trials.reading");
  }
  CHECK(reading_text(0.412) == "412 mm");
  CHECK(reading_text(0.4125) == "412.5 mm");
  CHECK(printable("a\x1b[2Jb\n") == "a [2Jb ");
}

TEST_CASE("input: lines, a last one without its end, and the rig's word in between") {
  int pipe_ends[2] = {-1, -1};
  REQUIRE(::pipe(pipe_ends) == 0);
  REQUIRE(::write(pipe_ends[1], "412\r\ng\nrest", 11) == 11);
  SeatInput input(pipe_ends[0], {});
  CHECK(*input.line({}) == "412");
  CHECK(*input.line({}) == "g");
  const auto interrupted = input.line([]() -> Status { return Fault{"rig.dark", "", "", ""}; });
  CHECK(interrupted.fault().code == "rig.dark");
  ::close(pipe_ends[1]);
  CHECK(*input.line({}) == "rest");
  CHECK(input.line({}).fault().code == "trials.input-ended");
  std::stop_source stop;
  stop.request_stop();
  CHECK(SeatInput(pipe_ends[0], stop.get_token()).next({}).fault().code == "trials.stopped");
  ::close(pipe_ends[0]);
}
