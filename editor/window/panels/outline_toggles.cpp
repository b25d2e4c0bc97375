#include "editor/window/panels/outline_toggles.h"

#include <string>
#include <string_view>
#include <vector>

#include "editor/session/edits.h"
#include "editor/session/outline_rows.h"
#include "editor/session/session.h"
#include "editor/window/base/icons.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"

namespace focalstage {
namespace {

/// A small picture on a row, pressed by itself. Seen only when `seen`, but always there.
bool row_toggle(const std::string& name, glm::vec2 min, glm::vec2 size, std::string_view icon_name, bool seen, bool on,
                const Tip& tip) {
  ImGui::SetCursorScreenPos(to_im(min));
  ImGui::PushID(name.c_str());
  const bool pressed = ImGui::InvisibleButton("toggle", to_im(size));
  ImGui::PopID();
  see_last_item(name);
  const bool hovered = ImGui::IsItemHovered();
  tip_for_last_item(tip);
  if (!seen && !hovered) return pressed;
  const std::string_view glyph = icon(icon_name);
  const glm::vec2 text = from_im(ImGui::CalcTextSize(glyph.data(), glyph.data() + glyph.size()));
  const glm::vec2 at = glm::floor(min + 0.5f * (size - text));
  ImGui::GetWindowDrawList()->AddText(to_im(at), hovered || on ? theme::text : theme::dim, glyph.data(),
                                      glyph.data() + glyph.size());
  return pressed;
}

void set_flag(Session& session, const OutlineRow& row, const char* key, bool on, const std::string& verb) {
  std::vector<Edit> edits;
  for (const Thing& thing : things_of(session.project(), row)) edits.push_back(set_edit(thing, key, Value(on)));
  (void)session.edit(verb + row.label, std::move(edits));
}

}  // namespace

void draw_toggles(Session& session, const OutlineRow& row, glm::vec2 min, glm::vec2 size_px, bool over) {
  const ImVec2 below = ImGui::GetCursorScreenPos();
  const NameScope scope(row.label);
  ImGui::PushID(row.thing.list.c_str());
  ImGui::PushID(row.label.c_str());
  if (row_toggle("lock", min, size_px, row.locked ? "locked" : "unlock", over || row.locked, row.locked,
                 {row.locked ? "Unlock it" : "Lock it: it can't be picked, moved or deleted", {}, {}})) {
    set_flag(session, row, "locked", !row.locked, row.locked ? "Unlock " : "Lock ");
  }
  if (row_toggle("eye", {min.x + size_px.x, min.y}, size_px, row.hidden ? "hidden" : "show", over || row.hidden,
                 row.hidden, {row.hidden ? "Show it" : "Hide it: neither drawn nor compiled", {}, {}})) {
    set_flag(session, row, "hidden", !row.hidden, row.hidden ? "Show " : "Hide ");
  }
  ImGui::PopID();
  ImGui::PopID();
  ImGui::SetCursorScreenPos(below);
}

}  // namespace focalstage
