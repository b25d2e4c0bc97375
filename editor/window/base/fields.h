#pragma once

#include <span>
#include <string>
#include <string_view>

#include "editor/window/base/tip.h"

namespace focalstage {

struct FieldStyle {
  std::string_view hint = {};  ///< shown while empty
  float width_px = 0.0f;       ///< 0: the item width
  bool focus = false;          ///< takes the keyboard in this frame
  bool mixed = false;          ///< several things differ
  Tip tip = {};
  bool select_all = false;  ///< of what is there when the keyboard comes: a name to be replaced
};

struct TextChange {
  bool changed = false;   ///< with each key
  bool finished = false;  ///< Enter, or the keyboard went elsewhere after a change
  bool entered = false;   ///< Enter
};

TextChange text_field(std::string_view name, std::string& text, const FieldStyle& style = {});

/// One of several; its items are known as "NAME/ITEM" while open. True when another was chosen.
bool combo(std::string_view name, int& index, std::span<const std::string> items, const FieldStyle& style = {});

/// True when it was switched.
bool check(std::string_view name, bool& on, const FieldStyle& style = {});

/// A value between `least` and `most` by a knob, with its number in it. True while it changes.
bool slider(std::string_view name, double& value, double least, double most, int digits, std::string_view unit,
            const FieldStyle& style = {});

}  // namespace focalstage
