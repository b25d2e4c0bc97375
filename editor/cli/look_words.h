#pragma once

#include <optional>
#include <string>

#include "core/percept/things.h"
#include "core/retina/retina.h"
#include "core/scene/value.h"

namespace focalstage {

/// "object" or "surface".
std::string kind_of(const SeenThing& thing);

/// "left" or "right".
std::string eye_word(Side eye);

/// Numbers that may not exist are null.
Value number_or_null(double value);

/// What a look at a show was asked for, as far as all that tell of one repeat it.
struct AskedLook {
  std::string show;
  int frame = 0;
  std::optional<double> focus_m;  ///< from the lens centre; none where it is swept
  double pupil_mm = 4.0;
};

/// Adds the members of `--json` that tell of it: show, frame, eye, focus_m and focus_d, pupil_mm, fov_deg, size_px.
void set_look(Value& object, const AskedLook& asked, const RetinaView& view);

}  // namespace focalstage
