#pragma once

#include <limits>
#include <string_view>

#include "editor/window/base/tip.h"

namespace focalstage {

struct NumberStyle {
  std::string_view unit = {};
  int digits = 3;
  double step = 0.005;  ///< per pixel of a drag; Shift: a tenth, Ctrl: ten times
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool mixed = false;     ///< several things differ: shows "—", takes typed numbers only
  float width_px = 0.0f;  ///< 0: the item width, which in a property row is the right column
  Tip tip = {};           ///< with `unavailable` set it can only be read
};

struct NumberChange {
  bool changed = false;   ///< the value is another one: `Session::drag`
  bool finished = false;  ///< the hand let go, or a number was typed: `Session::end_drag`
};

/// A number with its unit. Dragging across it changes it; a click lets one type ("12", "0,5", "40 cm"), Enter or Tab
/// takes it, Escape does not.
NumberChange number_field(std::string_view name, double& value, const NumberStyle& style = {});

}  // namespace focalstage
