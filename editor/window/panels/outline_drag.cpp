#include "editor/window/panels/outline_drag.h"

#include <cmath>
#include <cstddef>

#include "editor/session/session.h"
#include "editor/window/base/im.h"
#include "editor/window/base/theme.h"

namespace focalstage {

void OutlineDrag::follow(const OutlineRow& row) {
  const bool can = row.kind == OutlineRow::Kind::thing && !row.thing.name.empty();
  if (can && ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, px(5))) dragged_ = row.thing;
}

std::optional<OutlineDrag::Place> OutlineDrag::place(const DrawnRows& drawn) const {
  const float y = (ImGui::GetIO().MousePos.y - drawn.top_px) / drawn.row_px;
  if (!dragged_ || y < 0.0f || y >= static_cast<float>(drawn.rows.size())) return std::nullopt;
  const OutlineRow& row = drawn.rows[static_cast<std::size_t>(y)];
  if (row.kind != OutlineRow::Kind::thing || row.thing.list != dragged_->list) return std::nullopt;
  return Place{row.thing, y - std::floor(y) >= 0.5f};
}

void OutlineDrag::draw(const DrawnRows& drawn) const {
  ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
  if (!place(drawn)) return;
  const float y = drawn.top_px + std::round((ImGui::GetIO().MousePos.y - drawn.top_px) / drawn.row_px) * drawn.row_px;
  const ImVec2 from = ImGui::GetWindowPos();
  ImGui::GetWindowDrawList()->AddRectFilled({from.x, y - px(1)}, {from.x + ImGui::GetWindowWidth(), y + px(1)},
                                            theme::accent);
}

void OutlineDrag::drop(Session& session, const DrawnRows& drawn) {
  if (!dragged_ || ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;
  if (const auto at = place(drawn)) {
    (void)session.edit("Move " + dragged_->name + " in the list",
                       reorder_edits(session.project(), *dragged_, at->beside, at->after));
  }
  dragged_.reset();
}

}  // namespace focalstage
