#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace focalstage {

struct PlotTick {
  double at = 0.0;
  std::string text;
};

struct PlotAxis {
  std::string label;  ///< with its unit
  double from = 0.0;
  double to = 1.0;
  std::vector<PlotTick> ticks;  ///< those outside `from` to `to` are left out
};

/// One line; where y is not a number the line has a gap.
struct PlotLine {
  std::string name;
  std::vector<double> x, y;
};

/// Lines over one axis, for people: as many as there are, told apart by colour and, from the eighth on, by dashes.
struct LinePlot {
  std::string title;
  PlotAxis bottom, left;
  PlotAxis top;  ///< the same range as `bottom`, in another unit; without ticks it is not drawn
  std::vector<PlotLine> lines;
  std::string without_lines;  ///< what stands where lines would be if there are none
};

struct PlotPicture {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;  ///< rows from the top
};

/// Fault "plot.invalid": an axis whose ends are no numbers or not in order, a line whose x and y differ in number, a
/// size outside 200 to 8192 pixels, a text that is not UTF-8.
Result<PlotPicture> draw_plot(const LinePlot& plot, int width_px, int height_px);

/// About `wanted` round numbers (1, 2 or 5 times a power of ten apart) from `from` to `to`.
std::vector<PlotTick> round_ticks(double from, double to, int wanted);

}  // namespace focalstage
