#include "editor/window/app/keys.h"

#include <GLFW/glfw3.h>

#include <array>
#include <cctype>

namespace focalstage {
namespace {

struct Named {
  std::string_view name;
  int key;
};

constexpr std::array named_keys = {
    Named{"Space", GLFW_KEY_SPACE},    Named{"Enter", GLFW_KEY_ENTER},
    Named{"Escape", GLFW_KEY_ESCAPE},  Named{"Return", GLFW_KEY_ENTER},
    Named{"Esc", GLFW_KEY_ESCAPE},     Named{"Tab", GLFW_KEY_TAB},
    Named{"Delete", GLFW_KEY_DELETE},  Named{"Del", GLFW_KEY_DELETE},
    Named{"Insert", GLFW_KEY_INSERT},  Named{"Backspace", GLFW_KEY_BACKSPACE},
    Named{"Left", GLFW_KEY_LEFT},      Named{"Right", GLFW_KEY_RIGHT},
    Named{"Up", GLFW_KEY_UP},          Named{"Down", GLFW_KEY_DOWN},
    Named{"Home", GLFW_KEY_HOME},      Named{"End", GLFW_KEY_END},
    Named{"PageUp", GLFW_KEY_PAGE_UP}, Named{"+", GLFW_KEY_EQUAL},
    Named{"=", GLFW_KEY_EQUAL},        Named{"PageDown", GLFW_KEY_PAGE_DOWN},
    Named{"-", GLFW_KEY_MINUS},        Named{",", GLFW_KEY_COMMA},
    Named{".", GLFW_KEY_PERIOD},       Named{"/", GLFW_KEY_SLASH},
    Named{";", GLFW_KEY_SEMICOLON},    Named{"'", GLFW_KEY_APOSTROPHE},
    Named{"[", GLFW_KEY_LEFT_BRACKET}, Named{"]", GLFW_KEY_RIGHT_BRACKET},
    Named{"\\", GLFW_KEY_BACKSLASH},   Named{"`", GLFW_KEY_GRAVE_ACCENT},
    Named{"Pause", GLFW_KEY_PAUSE},
};

bool take_prefix(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

std::optional<int> function_key(std::string_view name) {
  if (name.size() < 2 || name.size() > 3 || name[0] != 'F') return std::nullopt;
  int number = 0;
  for (const char c : name.substr(1)) {
    if (c < '0' || c > '9') return std::nullopt;
    number = number * 10 + (c - '0');
  }
  if (number < 1 || number > 12) return std::nullopt;
  return GLFW_KEY_F1 + number - 1;
}

std::optional<int> key_named(std::string_view name) {
  for (const Named& named : named_keys) {
    if (named.name == name) return named.key;
  }
  if (const auto function = function_key(name)) return function;
  if (name.size() != 1) return std::nullopt;
  const auto letter = static_cast<unsigned char>(name[0]);
  // GLFW's codes of letters and digits are their capitals' in ASCII.
  if (std::isalnum(letter) != 0) return std::toupper(letter);
  return std::nullopt;
}

}  // namespace

std::optional<KeyChord> chord_named(std::string_view text) {
  KeyChord chord;
  for (bool more = true; more;) {
    more = false;
    if (take_prefix(text, "Ctrl+")) more = chord.ctrl = true;
    if (take_prefix(text, "Shift+")) more = chord.shift = true;
    if (take_prefix(text, "Alt+")) more = chord.alt = true;
  }
  const auto key = key_named(text);
  if (!key) return std::nullopt;
  chord.key = *key;
  return chord;
}

}  // namespace focalstage
