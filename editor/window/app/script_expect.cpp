// The steps of a script that look and tell.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/scene/pointer.h"
#include "editor/window/app/editor.h"
#include "editor/window/app/script_player.h"
#include "editor/window/base/widget_registry.h"
#include "io/json/json.h"

namespace focalstage {
namespace {

/// Equal, numbers anywhere inside within the tolerance.
bool agree(const Value& a, const Value& b, double tolerance) {
  if (a.number() != nullptr && b.number() != nullptr) return std::abs(*a.number() - *b.number()) <= tolerance;
  if (a.array() != nullptr && b.array() != nullptr) {
    return std::ranges::equal(*a.array(), *b.array(),
                              [&](const Value& x, const Value& y) { return agree(x, y, tolerance); });
  }
  if (a.object() != nullptr && b.object() != nullptr) {
    return std::ranges::equal(*a.object(), *b.object(), [&](const Value::Member& x, const Value::Member& y) {
      return x.first == y.first && agree(x.second, y.second, tolerance);
    });
  }
  return a == b;
}

std::string hex_of(glm::ivec3 rgb) {
  char text[16];
  std::snprintf(text, sizeof(text), "#%02x%02x%02x", static_cast<unsigned>(rgb.r), static_cast<unsigned>(rgb.g),
                static_cast<unsigned>(rgb.b));
  return text;
}

}  // namespace

Status ScriptPlayer::act(const ExpectValue& step) {
  const Value state = editor_.session().described();
  const Value* found = value_at(state, pointer_steps(step.pointer));
  if (found == nullptr) return wrong(step.pointer + " is not there");
  if (agree(*found, step.value, step.tolerance)) return {};
  return wrong(step.pointer + " is " + write_json(*found, -1) + ", not " + write_json(step.value, -1));
}

Status ScriptPlayer::act(const ExpectWidget& step) {
  const SeenWidget* widget = seen_widget(step.name);
  const bool there = widget != nullptr && widget->visible;
  if (there != step.absent) return {};
  return wrong("\"" + step.name + "\" is " + (there ? "there" : "not to be seen"));
}

Status ScriptPlayer::act(const ExpectColour& step) {
  settle();
  const auto pixel = pixel_of(step.place);
  if (!pixel) return pixel.fault();
  const glm::ivec2 at(*pixel);
  const glm::ivec2 size = editor_.painter().size_px();
  if (at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y) return wrong("this is outside of the window");
  const std::vector<std::uint8_t> pixels = editor_.painter().pixels();
  const auto first =
      (static_cast<std::size_t>(at.y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(at.x)) * 3;
  const glm::ivec3 seen(pixels[first], pixels[first + 1], pixels[first + 2]);
  const glm::ivec3 apart = glm::abs(seen - step.rgb);
  if (std::max({apart.r, apart.g, apart.b}) <= step.tolerance) return {};
  return wrong("the pixel " + std::to_string(at.x) + " " + std::to_string(at.y) + " is " + hex_of(seen) + ", not " +
               hex_of(step.rgb));
}

Status ScriptPlayer::act(const PrintValue& step) {
  const Value state = editor_.session().described();
  const bool whole = step.pointer.empty() || step.pointer == "/";
  const Value* found = whole ? &state : value_at(state, pointer_steps(step.pointer));
  std::printf("%s\n", found != nullptr ? write_json(*found).c_str() : "nothing");
  return {};
}

Status ScriptPlayer::act(const PrintWidgets&) {
  for (const SeenWidget& widget : seen_widgets()) {
    std::printf("%s at %.0f %.0f, %.0f x %.0f%s%s\n", widget.name.c_str(), static_cast<double>(widget.min.x),
                static_cast<double>(widget.min.y), static_cast<double>(widget.max.x - widget.min.x),
                static_cast<double>(widget.max.y - widget.min.y), widget.enabled ? "" : ", cannot be used",
                widget.visible ? "" : ", out of sight");
  }
  return {};
}

}  // namespace focalstage
