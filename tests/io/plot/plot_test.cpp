#include "io/plot/plot.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace focalstage;

namespace {

LinePlot plot_of(std::vector<PlotLine> lines) {
  LinePlot plot;
  plot.title = "t";
  plot.bottom = {"x (D)", 0.0, 4.0, round_ticks(0.0, 4.0, 4)};
  plot.left = {"y", 0.0, 1.0, round_ticks(0.0, 1.0, 5)};
  plot.lines = std::move(lines);
  plot.without_lines = "nothing to draw";
  return plot;
}

/// Pixels of a line's colour, the first one's: a saturated blue that neither text nor grid has.
int blue_pixels(const PlotPicture& picture, int from_x, int to_x) {
  int count = 0;
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = from_x; x < to_x; ++x) {
      const std::uint8_t* rgb = &picture.rgb[3 * (static_cast<std::size_t>(y) * picture.width_px + x)];
      count += rgb[2] > rgb[0] + 100 ? 1 : 0;
    }
  }
  return count;
}

std::vector<std::string> texts(const std::vector<PlotTick>& ticks) {
  std::vector<std::string> all;
  for (const PlotTick& tick : ticks) all.push_back(tick.text);
  return all;
}

}  // namespace

TEST_CASE("ticks are round numbers within the axis") {
  CHECK(texts(round_ticks(0.5, 3.5, 6)) == std::vector<std::string>{"0.5", "1.0", "1.5", "2.0", "2.5", "3.0", "3.5"});
  CHECK(texts(round_ticks(0.0, 1.0, 5)) == std::vector<std::string>{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"});
  CHECK(texts(round_ticks(-20.0, 20.0, 4)) == std::vector<std::string>{"-20", "-10", "0", "10", "20"});
  CHECK(round_ticks(2.0, 2.0, 5).empty());
  CHECK(round_ticks(std::nan(""), 1.0, 5).empty());
}

TEST_CASE("a line is drawn where its numbers are") {
  const auto whole = draw_plot(plot_of({{"a", {0, 1, 2, 3, 4}, {0.5, 0.5, 0.5, 0.5, 0.5}}}), 600, 400);
  REQUIRE(whole);
  CHECK(whole->rgb.size() == 3u * 600 * 400);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto half = draw_plot(plot_of({{"a", {0, 1, 2, 3, 4}, {0.5, 0.5, 0.5, nan, nan}}}), 600, 400);
  REQUIRE(half);
  const int legend = 500;  // its line of colour lies beyond
  CHECK(blue_pixels(*half, 0, 600) < blue_pixels(*whole, 0, 600) - 150);
  CHECK(blue_pixels(*half, 0, 290) == blue_pixels(*whole, 0, 290));
  CHECK(blue_pixels(*whole, legend, 600) > 20);
}

TEST_CASE("the same plot is the same picture") {
  const LinePlot plot = plot_of({{"a", {0, 4}, {0, 1}}, {"b", {0, 4}, {1, 0}}});
  CHECK(draw_plot(plot, 500, 300)->rgb == draw_plot(plot, 500, 300)->rgb);
}

TEST_CASE("without lines it says so, with a hundred it still draws") {
  const auto empty = draw_plot(plot_of({}), 500, 300);
  REQUIRE(empty);
  CHECK(blue_pixels(*empty, 0, 500) == 0);
  std::vector<PlotLine> many;
  for (int i = 0; i < 100; ++i) many.push_back({std::string(200, 'n'), {0, 4}, {0.01 * i, 0.01 * i}});
  CHECK(draw_plot(plot_of(many), 500, 300));
}

TEST_CASE("what cannot be drawn is a fault") {
  CHECK(draw_plot(plot_of({{"a", {0, 1}, {0.5}}}), 500, 300).fault().code == "plot.invalid");
  CHECK(draw_plot(plot_of({{"\xff\xfe", {0, 1}, {0.5, 1}}}), 500, 300).fault().code == "plot.invalid");
  CHECK(draw_plot(plot_of({}), 100, 300).fault().code == "plot.invalid");
  CHECK(draw_plot(plot_of({}), 500, 9000).fault().code == "plot.invalid");
  LinePlot plot = plot_of({});
  plot.bottom.to = plot.bottom.from;
  CHECK(draw_plot(plot, 500, 300).fault().code == "plot.invalid");
}
