#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "editor/cli/retina_options.h"
#include "editor/cli/retina_sweep.h"
#include "editor/cli/sweep_output.h"
#include "tests/support/temporary_folder.h"

using namespace focalstage;

namespace {

ThingLook look_of(int pixels, double sharpness) {
  ThingLook look;
  look.pixels = pixels;
  look.sharpness = sharpness;
  look.light = 0.25;
  look.blur_radius_arcmin = 3.0;
  return look;
}

/// A thing with contrast, one without, one that is not seen.
FocalSweep three_things() {
  FocalSweep sweep;
  sweep.focus_d = {0.0, 0.5, 1.0};
  sweep.things = {{SeenThing::Kind::object, "a, \"b\"", 0},
                  {SeenThing::Kind::surface, "even", 0},
                  {SeenThing::Kind::surface, "hidden", 1}};
  for (const double sharpness : {0.5, 0.9, 0.7})
    sweep.looks.push_back({look_of(10, sharpness), look_of(10, std::nan("")), look_of(0, 0.0)});
  for (std::size_t i = 0; i < 3; ++i) sweep.peaks.push_back(focus_peak(sweep.focus_d, sharpness_over(sweep, i)));
  return sweep;
}

}  // namespace

TEST_CASE("a range of foci is read as it is written") {
  const auto range = focus_range_of("0.5:3.5:31");
  REQUIRE(range);
  CHECK(range->at(0) == 0.5);
  CHECK(range->at(10) == doctest::Approx(1.5));
  CHECK(range->at(30) == 3.5);  // exactly
  CHECK(focus_range_of("0:100:2"));
  CHECK(focus_range_of("0:1e-3:1000"));
}

TEST_CASE("what is no range is refused with what to write") {
  for (const char* text : {"",         ":",        "1:2",       "1:2:",    "1:2:3:4",
                           "1:2:3 ",   "a:2:3",    "1,5:2:3",   "1:2:2.5", "1:2:99999999999999999999",
                           "2:1:3",    "1:1:3",    "1:2:1",     "1:2:0",   "1:2:-3",
                           "1:2:1001", "-0.1:2:3", "1:100.1:3", "nan:2:3", "1:nan:3",
                           "1:inf:3",  "-inf:2:3"}) {
    CAPTURE(text);
    const auto range = focus_range_of(text);
    REQUIRE_FALSE(range);
    CHECK(range.fault().code == "retina.sweep");
    CHECK(range.fault().remedy.find("FROM:TO:COUNT") != std::string::npos);
  }
}

TEST_CASE("pictures are named by place and focus, and no two alike") {
  CHECK(sweep_picture_name({0.5, 3.5, 31}, 7) == "focus-007-1.2000D.png");
  CHECK(sweep_picture_name({1.0, 1.00001, 3}, 1) != sweep_picture_name({1.0, 1.00001, 3}, 2));
}

TEST_CASE("the table quotes names and leaves out what is no number") {
  CHECK(contrast_csv(three_things()) ==
        "focus_d,focus_m,\"a, \"\"b\"\".sharpness\",\"a, \"\"b\"\".light\",\"a, \"\"b\"\".blur_radius_arcmin\","
        "even.sharpness,even.light,even.blur_radius_arcmin,hidden.sharpness,hidden.light,hidden.blur_radius_arcmin\n"
        "0,,0.5,0.25,3,,0.25,3,,0.25,3\n"
        "0.5,2,0.9,0.25,3,,0.25,3,,0.25,3\n"
        "1,1,0.7,0.25,3,,0.25,3,,0.25,3\n");
}

TEST_CASE("the plot has a line for each thing with contrast, dioptres below and metres above") {
  const LinePlot plot = contrast_plot("t", three_things());
  REQUIRE(plot.lines.size() == 1);
  CHECK(plot.lines.front().y == std::vector{0.5, 0.9, 0.7});
  CHECK(plot.bottom.from == 0.0);
  CHECK(plot.bottom.to == 1.0);
  CHECK(plot.top.ticks.front().text == "\u221e");
  bool metre = false;
  for (const PlotTick& tick : plot.top.ticks) metre = metre || (tick.text == "1" && tick.at == 1.0);
  CHECK(metre);
  CHECK(draw_plot(plot, 800, 500));
}

TEST_CASE("a stack goes into a folder, not into a file") {
  const TemporaryFolder folder;
  CHECK(check_sweep_folder(folder.path().string()));
  CHECK(check_sweep_folder((folder.path() / "new").string()));
  std::ofstream(folder.path() / "file") << "text";
  const Status file = check_sweep_folder((folder.path() / "file").string());
  REQUIRE_FALSE(file);
  CHECK(file.fault().message.find("folder") != std::string::npos);
}
