#pragma once

#include <string_view>

#include <glm/vec2.hpp>

#include "editor/window/base/button.h"
#include "editor/window/base/pane.h"

namespace focalstage {

/// A row of translucent labels and buttons over a picture, from a corner of a pane inwards. What does not fit into
/// the pane is left out.
class Chips {
 public:
  enum class Corner { top_left, top_right, bottom_left, bottom_right };

  Chips(const PaneRect& rect, Corner corner);

  /// The pane's name, a value: shows, answers nothing.
  void label(std::string_view icon_name, std::string_view text);

  /// True when pressed. `label` empty: the icon alone.
  bool button(std::string_view name, std::string_view label, ButtonStyle style);

  /// The next row, away from the corner's edge.
  void next_row();

 private:
  bool take(glm::vec2 size, glm::vec2& min);

  PaneRect rect_;
  bool right_;
  bool bottom_;
  float along_px_ = 0.0f;
  float other_end_px_ = 0.0f;  ///< taken at the far end of the first row
  float rows_px_ = 0.0f;
};

/// What the frame around a pane keeps for itself at the left and right of its top edge (title, fill button): chips of
/// the top corners stand beside it. Until the next call.
void reserve_top_corners(float left_px, float right_px);

}  // namespace focalstage
