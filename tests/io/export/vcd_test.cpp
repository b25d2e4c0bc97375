#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

#include "io/export/vcd.h"
#include "tests/io/export/vcd_reader.h"
#include "tests/io/show/sample.h"

namespace focalstage {
namespace {

/// A period of 10 ms: the left image at 2 ms for 0.5 ms, the light right behind it, the right image at 8 ms; each
/// triggered 3 ms before. The right shutter stays open over the period's end.
ShowHeader simple() {
  ShowHeader header = sample::header(1, 20, 10, 1);
  header.images = {{ImageEye::left, ImageKind::content, -0.5, 0},
                   {ImageEye::right, ImageKind::content, -0.5, 0},
                   {ImageEye::both, ImageKind::surface_light, 0, -1}};
  Schedule& schedule = header.schedule;
  schedule.period_s = 0.010;
  schedule.slots = {{0, Side::left, 0.002, 0.0005, -0.001, -0.5, 0.1},
                    {2, Side::left, 0.0025, 0.0005, -0.0005, 0, 0.1},
                    {1, Side::right, 0.008, 0.0005, 0.005, -0.5, 0.1}};
  schedule.shutter.left = {0.001, 0.004};
  schedule.shutter.right = {0.006, 0.0005};
  schedule.lens_power_d = {{-1, 1}, {-1, 0.75}};
  schedule.lens_drive_a = {{-0.025, 0.025}, {-0.02, 0.0125}};
  return header;
}

std::string bits(int number) {
  std::string text;
  for (int bit = 16; bit-- > 0;) text += (number >> bit & 1) ? '1' : '0';
  return text;
}

TEST_CASE("the dump shows what happens when, in steps of 100 ns") {
  const vcd::Document dump = vcd::read(timing_vcd(simple()));
  REQUIRE(dump.wrong == "");
  CHECK(dump.timescale == "100 ns");
  CHECK(dump.end == 200'000);  // two periods of 10 ms
  const auto at = [&](const std::string& name, double ms) {
    REQUIRE(dump.by_name.count(name) == 1);
    return dump.by_name.at(name).at(static_cast<std::int64_t>(ms * 1e4 + 0.5));
  };
  const std::string nothing(16, 'x');
  for (const double period_ms : {0.0, 10.0}) {
    CAPTURE(period_ms);
    // The left image until the very tick at which the light begins; no gap between them.
    CHECK(at("exposing", period_ms + 1.9999) == "0");
    CHECK(at("image", period_ms + 1.9999) == nothing);
    CHECK(at("exposing", period_ms + 2.0) == "1");
    CHECK(at("image", period_ms + 2.4999) == bits(0));
    CHECK(at("image", period_ms + 2.5) == bits(2));
    CHECK(at("exposing", period_ms + 2.9999) == "1");
    CHECK(at("exposing", period_ms + 3.0) == "0");
    CHECK(at("image", period_ms + 8.2) == bits(1));
    CHECK(at("image_0_left_m0_50D", period_ms + 2.2) == "1");
    CHECK(at("image_0_left_m0_50D", period_ms + 2.5) == "0");
    CHECK(at("image_2_both_p0_00D", period_ms + 2.5) == "1");
    // Triggers of 10 us: the right image's at 5 ms, and those of the next period's first two, at 9 and 9.5 ms.
    for (const double trigger_ms : {5.0, 9.0, 9.5}) {
      CHECK(at("trigger", period_ms + trigger_ms - 0.0001) == "0");
      CHECK(at("trigger", period_ms + trigger_ms) == "1");
      CHECK(at("trigger", period_ms + trigger_ms + 0.0099) == "1");
      CHECK(at("trigger", period_ms + trigger_ms + 0.01) == "0");
    }
    CHECK(at("left_shutter", period_ms) == "0");
    CHECK(at("left_shutter", period_ms + 1.0) == "1");
    CHECK(at("left_shutter", period_ms + 4.0) == "0");
    // Open over the end of the period before.
    CHECK(at("right_shutter", period_ms) == "1");
    CHECK(at("right_shutter", period_ms + 0.5) == "0");
    CHECK(at("right_shutter", period_ms + 6.0) == "1");
    CHECK(at("left_power_d", period_ms + 1.0) == "-1");
    CHECK(at("left_power_d", period_ms + 5.0) == "1");
    CHECK(at("right_power_d", period_ms + 5.0) == "0.75");
    CHECK(at("right_drive_a", period_ms + 9.0) == "0.0125");
  }
  CHECK(dump.by_name.at("trigger").values.size() == 1 + 2 * 2 * 3);
}

TEST_CASE("a dump of many images, and of nothing at all, is a dump") {
  ShowHeader header = simple();
  SUBCASE("more signals than printable characters") {
    header.images.resize(300, {ImageEye::right, ImageKind::content, 0.25, 1});
    CHECK(vcd::read(timing_vcd(header)).by_name.size() == 300 + 2 + 3 + 4);
  }
  SUBCASE("no slots, no waveform, no images") {
    header.images.clear();
    header.schedule.slots.clear();
    header.schedule.lens_power_d = {};
    header.schedule.lens_drive_a = {};
    CHECK(vcd::read(timing_vcd(header)).by_name.size() == 2 + 3 + 4);
  }
  SUBCASE("exposures on top of each other: the later one") {
    header.schedule.slots[1].start_s = 0.0022;
    const vcd::Document dump = vcd::read(timing_vcd(header));
    CHECK(dump.by_name.at("image").at(22'000) == bits(2));
    CHECK(dump.by_name.at("image").at(26'900) == bits(2));
    CHECK(dump.by_name.at("exposing").at(27'000) == "0");
  }
  CHECK(vcd::read(timing_vcd(header)).wrong == "");
}

TEST_CASE("the reader above can refuse") {
  const std::string good = timing_vcd(simple());
  const auto without = [&](const std::string& piece, const std::string& with) {
    std::string text = good;
    text.replace(text.find(piece), piece.size(), with);
    return vcd::read(text).wrong;
  };
  CHECK(without("$enddefinitions $end\n", "") != "");
  CHECK(without("$dumpvars\n", "") != "");
  CHECK(without("$upscope $end\n", "") != "");
  CHECK(without("#20000\n", "#0\n") != "");
  CHECK(without("r-1 ", "r-1x ") != "");
  CHECK(without("real 64", "real 32") != "");
}

TEST_CASE("GTKWave's own converter takes the dump") {
  if (std::system("command -v vcd2fst >/dev/null 2>&1") != 0) {
    MESSAGE("vcd2fst (gtkwave) is not installed: only the strict reader above has read the dump");
    return;
  }
  const sample::Folder folder;
  sample::put(folder / "timing.vcd", timing_vcd(simple()));
  const std::string command = "vcd2fst '" + (folder / "timing.vcd").string() + "' '" +
                              (folder / "timing.fst").string() + "' >'" + (folder / "log").string() + "' 2>&1";
  CHECK(std::system(command.c_str()) == 0);
  CHECK(std::filesystem::file_size(folder / "timing.fst") > 0);
}

}  // namespace
}  // namespace focalstage
