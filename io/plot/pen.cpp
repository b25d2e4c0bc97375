#include "io/plot/pen.h"

namespace focalstage {

Pen::Pen(int width_px, int height_px)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_px, height_px)),
      context_(cairo_create(surface_.get())) {
  cairo_set_source_rgb(cairo(), 1.0, 1.0, 1.0);
  cairo_paint(cairo());
  cairo_select_font_face(cairo(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
}

void Pen::ink(const InkColour& colour, double width_px) const {
  cairo_set_source_rgb(cairo(), colour.red, colour.green, colour.blue);
  cairo_set_line_width(cairo(), width_px);
}

void Pen::line(double x0, double y0, double x1, double y1) const {
  cairo_move_to(cairo(), x0, y0);
  cairo_line_to(cairo(), x1, y1);
  cairo_stroke(cairo());
}

double Pen::text_width(const std::string& text) const {
  cairo_text_extents_t extents;
  cairo_text_extents(cairo(), text.c_str(), &extents);
  return extents.x_advance;
}

void Pen::text(const std::string& text, double x, double y, const TextPlace& place) const {
  cairo_font_extents_t font;
  cairo_font_extents(cairo(), &font);
  const double along = -place.across * text_width(text);
  const double below = font.ascent - place.down * (font.ascent + font.descent);
  cairo_save(cairo());
  cairo_translate(cairo(), x, y);
  if (place.upwards) cairo_rotate(cairo(), -1.5707963267948966);
  cairo_move_to(cairo(), along, below);
  cairo_show_text(cairo(), text.c_str());
  cairo_restore(cairo());
}

}  // namespace focalstage
