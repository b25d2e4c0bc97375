#include "editor/window/views/off_rig_popup.h"

#include <algorithm>
#include <string>

#include <imgui.h>

#include "core/sensitivity/rig_errors.h"
#include "editor/session/session.h"
#include "editor/window/base/fields.h"
#include "editor/window/base/widgets.h"

namespace focalstage {
namespace {

constexpr double most = 10.0;  ///< times what a study of sensitivity takes
constexpr std::size_t most_rows = 14;

void draw_error(Session& session, const RigError& error) {
  const ErrorAmounts& amounts = session.view().rig_errors;
  const auto known = amounts.find(error.what);
  double amount = known == amounts.end() ? 0.0 : known->second;
  ImGui::AlignTextToFramePadding();
  text_line(error.what, amount == 0.0 ? theme::dim : theme::text);
  ImGui::SameLine(px(200));
  FieldStyle style;
  style.width_px = px(150);
  if (!slider(error.what, amount, -most * error.amount, most * error.amount, error.amount < 1.0 ? 2 : 1, error.unit,
              style)) {
    return;
  }
  Value args;
  args.set("what", error.what);
  args.set("amount", amount);
  (void)session.run("eye.off-rig", args);
}

}  // namespace

void draw_off_rig_popup(Session& session, const PaneRect& beside) {
  const std::vector<RigError> errors = rig_errors(session.project());
  const float row = ImGui::GetFrameHeightWithSpacing();
  const auto rows = static_cast<float>(std::min(errors.size(), most_rows));
  const ImVec2 size(px(384), (rows + 1.0f) * row + px(44));
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const glm::vec2 wanted(beside.min.x + beside.size.x + px(8), beside.min.y);
  ImGui::SetNextWindowPos({std::max(0.0f, std::min(wanted.x, window.x - size.x - px(8))),
                           std::max(0.0f, std::min(wanted.y, window.y - size.y - px(8)))});
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(12), px(10)});
  const bool open = ImGui::BeginPopup(off_rig_popup, ImGuiWindowFlags_NoMove);
  ImGui::PopStyleVar();
  if (!open) return;
  ImGui::AlignTextToFramePadding();
  text_line("What if the rig is off by", theme::text);
  ImGui::SameLine(px(262));
  ButtonStyle reset;
  const bool as_said = session.view().rig_errors.empty();
  reset.tip = {"Everything where the project says", {}, as_said ? "It is" : ""};
  if (button("As it is said", reset)) (void)session.run("eye.off-rig");
  ImGui::BeginChild("errors", {0.0f, 0.0f});
  for (const RigError& error : errors) draw_error(session, error);
  ImGui::EndChild();
  ImGui::EndPopup();
}

}  // namespace focalstage
