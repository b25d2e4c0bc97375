#include "devices/lightcrafter/packets.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <sstream>
#include <string>

namespace focalstage::lightcrafter {
namespace {

/// Bytes as they are printed in data sheets: "40 01 03".
Bytes bytes_of(const std::string& hex) {
  std::istringstream in(hex);
  Bytes bytes;
  unsigned value = 0;
  while (in >> std::hex >> value) bytes.push_back(static_cast<std::uint8_t>(value));
  return bytes;
}

Report report_of(const std::string& hex) {
  Report report{};
  const Bytes bytes = bytes_of(hex);
  std::copy(bytes.begin(), bytes.end(), report.begin());
  return report;
}

TEST_CASE("golden messages") {
  const auto write = [](Command command, std::uint8_t sequence, const Bytes& payload) {
    return write_message(command, sequence, payload);
  };
  CHECK(read_message(Command::hardware_status) == bytes_of("C0 00 02 00 0A 1A"));
  CHECK(read_message(Command::main_status) == bytes_of("C0 00 02 00 0C 1A"));
  CHECK(read_message(Command::version) == bytes_of("C0 00 02 00 05 02"));
  CHECK(read_message(Command::validate) == bytes_of("C0 00 02 00 1A 1A"));
  CHECK(write(Command::pattern_run, 1, {0}) == bytes_of("40 01 03 00 24 1A 00"));
  CHECK(write(Command::power, 2, {0}) == bytes_of("40 02 03 00 00 02 00"));
  CHECK(write(Command::display_mode, 3, {1}) == bytes_of("40 03 03 00 1B 1A 01"));
  CHECK(write(Command::pattern_source, 4, {0}) == bytes_of("40 04 03 00 22 1A 00"));
  CHECK(write(Command::trigger_mode, 5, {0}) == bytes_of("40 05 03 00 23 1A 00"));
  CHECK(write(Command::pattern_config, 6, pattern_config_bytes(24, 24, 1, true)) ==
        bytes_of("40 06 06 00 31 1A 17 01 17 00"));
  CHECK(write(Command::exposure, 7, exposure_bytes(694, 694)) == bytes_of("40 07 0A 00 29 1A B6 02 00 00 B6 02 00 00"));
  CHECK(write(Command::trigger_out_1, 8, {0, 0xBB, 0xBB}) == bytes_of("40 08 05 00 1D 1A 00 BB BB"));
  CHECK(write(Command::trigger_out_2, 9, {0, 0xBB}) == bytes_of("40 09 04 00 1E 1A 00 BB"));
  CHECK(write(Command::mailbox_control, 10, {2}) == bytes_of("40 0A 03 00 33 1A 02"));
  CHECK(write(Command::mailbox_address, 11, {0}) == bytes_of("40 0B 03 00 32 1A 00"));
  CHECK(write(Command::mailbox_control, 13, {0}) == bytes_of("40 0D 03 00 33 1A 00"));
  CHECK(write(Command::validate, 14, {0}) == bytes_of("40 0E 03 00 1A 1A 00"));
  CHECK(write(Command::pattern_run, 15, {2}) == bytes_of("40 0F 03 00 24 1A 02"));
  CHECK(write(Command::power, 16, {1}) == bytes_of("40 10 03 00 00 02 01"));
  CHECK(write(Command::led_enable, 17, {8}) == bytes_of("40 11 03 00 07 1A 08"));
  CHECK(write(Command::led_enable, 18, {0}) == bytes_of("40 12 03 00 07 1A 00"));
}

TEST_CASE("the golden table of 24 patterns travels in two reports") {
  std::vector<LutEntry> entries(24);
  for (std::size_t k = 0; k < 24; ++k) {
    entries[k].trigger = k == 0 ? LutEntry::Trigger::external_positive : LutEntry::Trigger::none;
    entries[k].pattern = static_cast<std::uint8_t>(k);
    entries[k].bits = 1;
  }
  const Bytes message = write_message(Command::mailbox_data, 12, lut_bytes(entries));
  CHECK(message.size() == 78);
  const std::vector<Report> reports = reports_of(message);
  REQUIRE(reports.size() == 2);
  const Bytes begin = bytes_of("40 0C 4A 00 34 1A 01 71 00 07 71 00 0B 71 00 0F 71 00");
  CHECK(std::equal(begin.begin(), begin.end(), reports[0].begin()));
  CHECK(reports[0][63] == 0x4F);
  CHECK(reports[1] == report_of("71 00 53 71 00 57 71 00 5B 71 00 5F 71 00"));
}

TEST_CASE("messages at the edges of reports") {
  const auto reports_for = [](std::size_t payload) {
    return reports_of(write_message(Command::mailbox_data, 0, Bytes(payload, 0xAA))).size();
  };
  CHECK(reports_for(58) == 1);
  CHECK(reports_for(59) == 2);
  CHECK(reports_for(58 + 64) == 2);
  CHECK(reports_for(58 + 65) == 3);
}

TEST_CASE("table entries, bit by bit") {
  LutEntry entry{LutEntry::Trigger::external_negative, 5, 4, 2, true, true, true, true};
  CHECK(lut_word(entry) == (2U | 5U << 2 | 4U << 8 | 2U << 12 | 0xFU << 16));
  entry = {LutEntry::Trigger::none, 0x3F, 8, 7, false, true, false, false};
  CHECK(lut_bytes(std::span(&entry, 1)) == bytes_of("FF 78 02"));
  CHECK(variable_bytes(entry, 694, 0x01020304) == bytes_of("FF 78 02 00 B6 02 00 00 04 03 02 01"));
  CHECK(variable_config_bytes(1824, 24, 1, true) == bytes_of("1F 07 17 00 00 01"));
}

TEST_CASE("LED currents are the other way round, and cut") {
  CHECK(led_current_bytes(0.0) == Bytes{0xFF, 0xFF, 0xFF});
  CHECK(led_current_bytes(1.0) == Bytes{0x00, 0x00, 0x00});
  CHECK(led_current_bytes(0.2) == Bytes{0xCC, 0xCC, 0xCC});
  CHECK(led_current_bytes(-1.0) == Bytes{0xFF, 0xFF, 0xFF});
  CHECK(led_current_bytes(7.0) == Bytes{0x00, 0x00, 0x00});
  CHECK(led_current_bytes(std::numeric_limits<double>::quiet_NaN()) == Bytes{0xFF, 0xFF, 0xFF});
}

TEST_CASE("answers") {
  const auto running = parse_answer(report_of("C0 00 01 00 02"));
  REQUIRE(running);
  CHECK(running->to_read);
  CHECK_FALSE(running->nack);
  CHECK(running->data == Bytes{2});
  const auto refused = parse_answer(report_of("E0 00 00 00"));
  REQUIRE(refused);
  CHECK(refused->nack);
  const auto written = parse_answer(report_of("40 0C 00 00"));
  REQUIRE(written);
  CHECK_FALSE(written->to_read);
  CHECK(written->sequence == 12);
  CHECK(parse_answer(report_of("C0 00 3C 00"))->data.size() == 60);
  CHECK_FALSE(parse_answer(report_of("C0 00 3D 00")));
  CHECK_FALSE(parse_answer(report_of("C0 00 FF FF")));
}

TEST_CASE("status registers") {
  CHECK(trouble_in(hardware_status(0x01)).empty());
  for (const int bits : {0x00, 0x03, 0x05, 0x09, 0x41, 0x81}) {
    CAPTURE(bits);
    CHECK_FALSE(trouble_in(hardware_status(static_cast<std::uint8_t>(bits))).empty());
  }
  CHECK(trouble_in(hardware_status(0x31)).empty());  // reserved
  CHECK(main_status(0x02).running);
  CHECK_FALSE(main_status(0x05).running);
  CHECK(main_status(0x01).parked);
  CHECK(main_status(0x04).frozen);
  CHECK(validation(0x80).busy);
  CHECK_FALSE(validation(0x80).ok());
  CHECK(validation(0x00).ok());
  CHECK_FALSE(validation(0x01).ok());
  CHECK_FALSE(validation(0x02).ok());
  CHECK(validation(0x1C).ok());
  CHECK(validation(0x04).trigger_overlap);
  CHECK(validation(0x08).black_missing);
  CHECK(validation(0x10).short_gap);
}

TEST_CASE("version and video signal") {
  Bytes version(16, 0);
  version[0] = 0x2C;
  version[1] = 0x01;
  version[2] = 1;
  version[3] = 3;
  const auto read = application_version(version);
  REQUIRE(read);
  CHECK(read->major == 3);
  CHECK(read->minor == 1);
  CHECK(read->patch == 300);
  CHECK_FALSE(application_version(Bytes(15)));
  Bytes signal(28, 0);
  signal[20] = 0x90;
  signal[21] = 0x03;
  signal[22] = 0x74;
  signal[23] = 0x04;
  REQUIRE(video_signal(signal));
  CHECK(video_signal(signal)->active_px == 912);
  CHECK(video_signal(signal)->active_lines == 1140);
  CHECK_FALSE(video_signal(Bytes(27)));
}

TEST_CASE("whatever comes is read within its bounds") {
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    Report report;
    for (auto& byte : report) byte = static_cast<std::uint8_t>(random());
    if (i % 2 == 0) report[3] = 0;
    const auto answer = parse_answer(report);
    if (!answer) continue;
    CHECK(answer->data.size() <= 60);
    (void)application_version(answer->data);
    (void)video_signal(answer->data);
  }
}

}  // namespace
}  // namespace focalstage::lightcrafter
