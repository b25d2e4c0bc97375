#pragma once

#include <cairo.h>

#include <memory>
#include <string>

namespace focalstage {

/// A rectangle of the picture in pixels.
struct PlotBox {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
};

struct InkColour {
  double red = 0.0, green = 0.0, blue = 0.0;
};

/// Where a text stands about its point: 0 begins there, 0.5 is centred, 1 ends there.
struct TextPlace {
  double across = 0.0;
  double down = 0.5;
  bool upwards = false;  ///< turned by a quarter, read from below
};

/// Cairo's surface and context, held as long as they are needed.
class Pen {
 public:
  Pen(int width_px, int height_px);

  cairo_t* cairo() const { return context_.get(); }
  cairo_surface_t* surface() const { return surface_.get(); }
  bool ok() const { return cairo_status(context_.get()) == CAIRO_STATUS_SUCCESS; }

  void ink(const InkColour& colour, double width_px = 1.0) const;
  void line(double x0, double y0, double x1, double y1) const;
  void text(const std::string& text, double x, double y, const TextPlace& place) const;
  void text_size(double px) const { cairo_set_font_size(cairo(), px); }
  double text_width(const std::string& text) const;

 private:
  struct Free {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
  };
  std::unique_ptr<cairo_surface_t, Free> surface_;
  std::unique_ptr<cairo_t, Free> context_;
};

}  // namespace focalstage
