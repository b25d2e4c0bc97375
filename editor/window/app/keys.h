#pragma once

#include <optional>
#include <string_view>

namespace focalstage {

/// A key with what is held beside it. `key`: GLFW's code.
struct KeyChord {
  int key = 0;
  bool ctrl = false;
  bool shift = false;
  bool alt = false;

  bool operator==(const KeyChord&) const = default;
};

/// "Ctrl+Shift+S", "F5", "Delete", "Ctrl++". None where it is no key.
std::optional<KeyChord> chord_named(std::string_view text);

}  // namespace focalstage
