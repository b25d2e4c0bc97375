#pragma once

#include <string>

#include "core/scene/value.h"
#include "editor/session/property.h"

namespace focalstage {

/// What a hand did to a row.
struct PropertyChange {
  Value value;           ///< null: taken away
  bool changed = false;  ///< to `value`
  bool moving = false;   ///< and the hand goes on
  bool let_go = false;   ///< the hand that moved let go
  bool pressed = false;  ///< of an action
};

/// Draws rows and keeps what is being typed.
class PropertyFields {
 public:
  /// `unavailable`: why an action's command cannot be run now.
  PropertyChange draw(const Property& row, const std::string& unavailable = {});

 private:
  PropertyChange draw_number(const Property& row);
  PropertyChange draw_text(const Property& row);
  PropertyChange draw_choice(const Property& row);
  PropertyChange draw_flag(const Property& row);
  PropertyChange draw_colour(const Property& row);
  PropertyChange draw_picker(const Property& row);
  PropertyChange draw_unset(const Property& row);

  std::string typing_id_;  ///< the row whose text is being typed
  std::string typed_;
};

}  // namespace focalstage
