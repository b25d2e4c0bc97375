#include "editor/window/base/widget_registry.h"

#include <algorithm>

#include "editor/window/base/im.h"

namespace focalstage {
namespace {

std::string prefix;
std::vector<SeenWidget> seen;

}  // namespace

NameScope::NameScope(std::string_view part) : length_before_(prefix.size()) {
  prefix += part;
  prefix += '/';
}

NameScope::~NameScope() { prefix.resize(length_before_); }

void forget_widgets() { seen.clear(); }

void see_widget(std::string_view name, glm::vec2 min, glm::vec2 max, bool enabled) {
  const ImDrawList& list = *ImGui::GetWindowDrawList();
  const glm::vec2 low = glm::max(min, from_im(list.GetClipRectMin()));
  const glm::vec2 high = glm::min(max, from_im(list.GetClipRectMax()));
  const bool visible = high.x - low.x >= 1.0f && high.y - low.y >= 1.0f;
  seen.push_back({prefix + std::string(name), visible ? low : min, visible ? high : max, enabled, visible});
}

void see_last_item(std::string_view name, bool enabled) {
  see_widget(name, from_im(ImGui::GetItemRectMin()), from_im(ImGui::GetItemRectMax()), enabled);
}

const std::vector<SeenWidget>& seen_widgets() { return seen; }

const SeenWidget* seen_widget(std::string_view name) {
  const SeenWidget* any = nullptr;
  for (const SeenWidget& widget : seen) {
    if (widget.name != name) continue;
    if (widget.visible) return &widget;
    any = &widget;
  }
  return any;
}

}  // namespace focalstage
