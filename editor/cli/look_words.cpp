#include "editor/cli/look_words.h"

#include <cmath>

namespace focalstage {

std::string kind_of(const SeenThing& thing) { return thing.kind == SeenThing::Kind::object ? "object" : "surface"; }

std::string eye_word(Side eye) { return eye == Side::left ? "left" : "right"; }

Value number_or_null(double value) { return std::isfinite(value) ? Value(value) : Value(); }

void set_look(Value& object, const AskedLook& asked, const RetinaView& view) {
  object.set("show", asked.show);
  object.set("frame", asked.frame);
  object.set("eye", eye_word(view.eye));
  if (asked.focus_m) {
    object.set("focus_m", *asked.focus_m);
    object.set("focus_d", view.focus_d);
  }
  object.set("pupil_mm", asked.pupil_mm);
  object.set("fov_deg", view.fov_deg);
  object.set("size_px", Value::Array{view.width_px, view.height_px});
}

}  // namespace focalstage
