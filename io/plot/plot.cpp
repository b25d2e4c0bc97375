#include "io/plot/plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/plot/pen.h"

namespace focalstage {
namespace {

constexpr InkColour black{0.1, 0.1, 0.1};
constexpr InkColour gray{0.86, 0.86, 0.86};
constexpr double text_px = 13.0;
constexpr double row_px = 20.0;

/// Told apart by everyone (Okabe and Ito 2008).
constexpr std::array<InkColour, 7> colours{{{0.0, 0.45, 0.70},
                                            {0.84, 0.37, 0.0},
                                            {0.0, 0.62, 0.45},
                                            {0.80, 0.47, 0.65},
                                            {0.90, 0.62, 0.0},
                                            {0.34, 0.71, 0.91},
                                            {0.1, 0.1, 0.1}}};

Fault unfit(std::string message) { return {"plot.invalid", "", std::move(message), ""}; }

bool in_order(const PlotAxis& axis) {
  return std::isfinite(axis.from) && std::isfinite(axis.to) && axis.from < axis.to;
}

Status check(const LinePlot& plot, int width_px, int height_px) {
  if (std::min(width_px, height_px) < 200 || std::max(width_px, height_px) > 8192)
    return unfit("a plot has 200 to 8192 pixels a side");
  if (!in_order(plot.bottom) || !in_order(plot.left)) return unfit("an axis has no two ends in order");
  for (const PlotLine& line : plot.lines)
    if (line.x.size() != line.y.size()) return unfit("the line '" + line.name + "' has not as many x as y");
  return {};
}

/// What does not fit is cut between letters, never within one of UTF-8.
std::string shortened(const Pen& pen, const std::string& text, double most_px) {
  if (pen.text_width(text) <= most_px) return text;
  std::string part = text;
  while (!part.empty() && pen.text_width(part + "...") > most_px) {
    while (part.size() > 1 && (static_cast<unsigned char>(part.back()) & 0xC0) == 0x80) part.pop_back();
    part.pop_back();
  }
  return part + "...";
}

class Drawing {
 public:
  Drawing(const LinePlot& plot, const Pen& pen, int width_px, int height_px) : plot_(plot), pen_(pen) {
    pen.text_size(text_px);
    const double most_px = 0.3 * width_px;
    double names_px = 0.0;
    for (const PlotLine& line : plot.lines) names_px = std::max(names_px, std::min(most_px, pen.text_width(line.name)));
    legend_px_ = plot.lines.empty() ? 0.0 : names_px + 45.0;
    names_px_ = names_px;
    box_ = {68.0, plot.top.ticks.empty() ? 40.0 : 82.0, width_px - 20.0 - legend_px_, height_px - 56.0};
  }

  void draw() const {
    axes();
    for (std::size_t i = 0; i < plot_.lines.size(); ++i) curve(i);
    legend();
    if (plot_.lines.empty())
      pen_.text(plot_.without_lines, (box_.left + box_.right) / 2.0, (box_.top + box_.bottom) / 2.0, {0.5, 0.5});
  }

 private:
  double x_of(double value) const {
    return box_.left + (value - plot_.bottom.from) / (plot_.bottom.to - plot_.bottom.from) * (box_.right - box_.left);
  }
  double y_of(double value) const {
    return box_.bottom - (value - plot_.left.from) / (plot_.left.to - plot_.left.from) * (box_.bottom - box_.top);
  }
  static bool lies_on(const PlotAxis& axis, double at) {
    const double slack = 1e-9 * (axis.to - axis.from);
    return at >= axis.from - slack && at <= axis.to + slack;
  }

  void axes() const {
    for (const PlotTick& tick : plot_.bottom.ticks) {
      if (!lies_on(plot_.bottom, tick.at)) continue;
      pen_.ink(gray);
      pen_.line(x_of(tick.at), box_.top, x_of(tick.at), box_.bottom);
      pen_.ink(black);
      pen_.text(tick.text, x_of(tick.at), box_.bottom + 14.0, {0.5, 0.5});
    }
    for (const PlotTick& tick : plot_.left.ticks) {
      if (!lies_on(plot_.left, tick.at)) continue;
      pen_.ink(gray);
      pen_.line(box_.left, y_of(tick.at), box_.right, y_of(tick.at));
      pen_.ink(black);
      pen_.text(tick.text, box_.left - 8.0, y_of(tick.at), {1.0, 0.5});
    }
    pen_.ink(black);
    cairo_rectangle(pen_.cairo(), box_.left, box_.top, box_.right - box_.left, box_.bottom - box_.top);
    cairo_stroke(pen_.cairo());
    const double middle = (box_.left + box_.right) / 2.0;
    pen_.text(plot_.bottom.label, middle, box_.bottom + 38.0, {0.5, 0.5});
    pen_.text(plot_.left.label, 20.0, (box_.top + box_.bottom) / 2.0, {0.5, 0.5, true});
    for (const PlotTick& tick : plot_.top.ticks) {
      if (!lies_on(plot_.bottom, tick.at)) continue;
      pen_.line(x_of(tick.at), box_.top - 5.0, x_of(tick.at), box_.top);
      pen_.text(tick.text, x_of(tick.at), box_.top - 15.0, {0.5, 0.5});
    }
    if (!plot_.top.ticks.empty()) pen_.text(plot_.top.label, middle, box_.top - 36.0, {0.5, 0.5});
    pen_.text(plot_.title, box_.left, 18.0, {0.0, 0.5});
  }

  void line_ink(std::size_t i) const {
    pen_.ink(colours[i % colours.size()], 2.0);
    const double dash = 3.0 + 3.0 * static_cast<double>(i / colours.size());
    const std::array<double, 2> dashes{dash, 3.0};
    cairo_set_dash(pen_.cairo(), dashes.data(), i < colours.size() ? 0 : 2, 0.0);
  }

  void curve(std::size_t i) const {
    const PlotLine& line = plot_.lines[i];
    line_ink(i);
    cairo_save(pen_.cairo());
    cairo_rectangle(pen_.cairo(), box_.left, box_.top - 2.0, box_.right - box_.left, box_.bottom - box_.top + 4.0);
    cairo_clip(pen_.cairo());
    bool drawing = false;
    for (std::size_t k = 0; k < line.x.size(); ++k) {
      const bool number = std::isfinite(line.x[k]) && std::isfinite(line.y[k]);
      if (number && drawing) cairo_line_to(pen_.cairo(), x_of(line.x[k]), y_of(line.y[k]));
      if (number && !drawing) cairo_move_to(pen_.cairo(), x_of(line.x[k]), y_of(line.y[k]));
      drawing = number;
    }
    cairo_stroke(pen_.cairo());
    cairo_restore(pen_.cairo());
    cairo_set_dash(pen_.cairo(), nullptr, 0, 0.0);
  }

  void legend() const {
    const auto rows = static_cast<std::size_t>(std::max(1.0, (box_.bottom - box_.top) / row_px));
    const bool all = plot_.lines.size() <= rows;
    const std::size_t shown = all ? plot_.lines.size() : rows - 1;
    double y = box_.top + 8.0;
    for (std::size_t i = 0; i < shown; ++i, y += row_px) {
      line_ink(i);
      pen_.line(box_.right + 12.0, y, box_.right + 38.0, y);
      cairo_set_dash(pen_.cairo(), nullptr, 0, 0.0);
      pen_.ink(black);
      pen_.text(shortened(pen_, plot_.lines[i].name, names_px_), box_.right + 44.0, y, {0.0, 0.5});
    }
    if (!all)
      pen_.text("and " + std::to_string(plot_.lines.size() - shown) + " more", box_.right + 12.0, y, {0.0, 0.5});
  }

  const LinePlot& plot_;
  const Pen& pen_;
  PlotBox box_;
  double legend_px_ = 0.0, names_px_ = 0.0;
};

}  // namespace

Result<PlotPicture> draw_plot(const LinePlot& plot, int width_px, int height_px) {
  if (Status fits = check(plot, width_px, height_px); !fits) return fits.fault();
  const Pen pen(width_px, height_px);
  Drawing(plot, pen, width_px, height_px).draw();
  if (!pen.ok()) return unfit(std::string("cairo: ") + cairo_status_to_string(cairo_status(pen.cairo())));
  cairo_surface_flush(pen.surface());
  const unsigned char* const data = cairo_image_surface_get_data(pen.surface());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(pen.surface()));
  PlotPicture picture{width_px, height_px, {}};
  for (std::size_t y = 0; y < static_cast<std::size_t>(height_px); ++y) {
    for (std::size_t x = 0; x < static_cast<std::size_t>(width_px); ++x) {
      std::uint32_t pixel = 0;  // 0x00rrggbb in the machine's own order
      std::copy_n(data + y * stride + 4 * x, 4, reinterpret_cast<unsigned char*>(&pixel));
      for (const int shift : {16, 8, 0}) picture.rgb.push_back(static_cast<std::uint8_t>(pixel >> shift & 0xFF));
    }
  }
  return picture;
}

}  // namespace focalstage
