#include "editor/window/panels/outline_rename.h"

#include <string_view>
#include <utility>
#include <vector>

#include "editor/session/outline_rows.h"
#include "editor/session/session.h"
#include "editor/window/base/frame_wish.h"
#include "editor/window/base/icons.h"
#include "editor/window/base/im.h"
#include "editor/window/base/widgets.h"
#include "editor/window/panels/key_pressed.h"

namespace focalstage {

bool OutlineRename::is_of(const Session& session, const OutlineRow& row) const {
  if (row.kind == OutlineRow::Kind::group) return renamed_group_ == row.thing;
  return session.view().renaming == row.thing && !row.thing.name.empty();
}

void OutlineRename::begin(Session& session, const OutlineRow& row) {
  if (row.thing.name.empty()) return;
  session.view().renaming.reset();
  renamed_group_.reset();
  if (row.kind == OutlineRow::Kind::group) {
    renamed_group_ = row.thing;
  } else {
    session.view().renaming = row.thing;
  }
}

void OutlineRename::draw(Session& session, const OutlineRow& row, float row_px) {
  const glm::vec2 min = from_im(ImGui::GetCursorScreenPos());
  const bool begins = typing_for_ != row.thing;
  if (begins) typed_ = row.label;
  FieldStyle style;
  style.focus = begins;
  style.select_all = true;
  style.width_px = ImGui::GetContentRegionAvail().x - px(row.inside ? 44 : 26);
  ImGui::SetCursorScreenPos({min.x + px(row.inside ? 44 : 26), min.y});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {px(4), px(3)});
  const TextChange change = text_field("rename", typed_, style);
  ImGui::PopStyleVar();
  const bool left = ImGui::IsItemDeactivated();
  const std::string_view glyph = icon(row.icon);
  ImGui::GetWindowDrawList()->AddText({min.x + px(row.inside ? 24 : 6), min.y + px(3)}, theme::dim, glyph.data(),
                                      glyph.data() + glyph.size());
  ImGui::SetCursorScreenPos({min.x, min.y + row_px});
  typing_for_ = row.thing;
  if (begins) {
    want_frame_within(0.0);  // the field takes the keyboard in the frame after
  } else if (change.finished || left) {
    finish(session, row, !key_pressed(ImGuiKey_Escape));
  }
}

void OutlineRename::finish(Session& session, const OutlineRow& row, bool take) {
  session.view().renaming.reset();
  renamed_group_.reset();
  typing_for_.reset();
  if (!take || typed_ == row.label) return;
  if (row.kind == OutlineRow::Kind::group) {
    std::vector<Edit> edits;
    for (const Thing& thing : members_of(session.project(), row.thing)) {
      edits.push_back({Edit::Kind::group, thing.list, thing.name, "", Value(typed_)});
    }
    (void)session.edit("Rename group " + row.label + " to " + typed_, std::move(edits));
    return;
  }
  Value args;
  args.set("name", typed_);
  args.set("list", row.thing.list);
  args.set("of", row.thing.name);
  (void)session.run("edit.rename", args);
}

}  // namespace focalstage
