#include "editor/window/views/room_toolbar.h"

#include <initializer_list>
#include <string>
#include <string_view>

#include <imgui.h>

#include "editor/session/command.h"
#include "editor/window/base/chips.h"
#include "editor/window/base/widgets.h"

namespace focalstage {
namespace {

/// A chip that runs a command, with that command's help.
void command_chip(Session& session, Chips& chips, std::string_view id, std::string_view icon, std::string_view label,
                  bool down) {
  const Command* command = command_named(id);
  if (command == nullptr) return;
  if (command->shown != nullptr && !command->shown(session)) return;
  const std::string unavailable = command->unavailable(session);
  ButtonStyle style;
  style.icon = icon;
  style.down = down;
  style.tip = {command->help, command->shortcut, unavailable};
  if (chips.button(id, label, style)) (void)session.run(id);
}

void menu_row(Session& session, std::string_view id, bool on) {
  const Command* command = command_named(id);
  if (command == nullptr || (command->shown != nullptr && !command->shown(session))) return;
  const std::string unavailable = command->unavailable(session);
  ListRowStyle style;
  style.icon = "check";
  style.icon_colour = on ? theme::text : theme::with_alpha(theme::text, 0.0);  // its room stays: titles in one line
  style.right = command->shortcut;
  style.tip = {command->help, command->shortcut, unavailable};
  if (list_row(id, command->title, style).clicked) {
    (void)session.run(id);
    ImGui::CloseCurrentPopup();
  }
}

std::string_view space_name(HandleSpace space) {
  switch (space) {
    case HandleSpace::world:
      return "World";
    case HandleSpace::local:
      return "Local";
    case HandleSpace::sight:
      break;
  }
  return "Sight";
}

void draw_view_menu(RoomFrame& frame) {
  const ViewState& state = frame.session.view();
  ImGui::SetNextWindowPos({ImGui::GetItemRectMin().x, ImGui::GetItemRectMax().y + px(4)});
  ImGui::SetNextWindowSize({px(290), 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(6), px(6)});  // panes have none
  const bool open = ImGui::BeginPopup("room-view");
  ImGui::PopStyleVar();
  if (!open) return;
  for (const std::string_view id : {"view.home", "view.zoom-selection", "view.front", "view.right", "view.top"}) {
    menu_row(frame.session, id, false);
  }
  ImGui::Separator();
  menu_row(frame.session, "view.left-eye", state.look_through == LookThrough::left_eye);
  menu_row(frame.session, "view.right-eye", state.look_through == LookThrough::right_eye);
  menu_row(frame.session, "view.projector", state.look_through == LookThrough::projector);
  ImGui::Separator();
  menu_row(frame.session, "view.sheets", state.show_sheets);
  menu_row(frame.session, "view.frusta", state.show_frusta);
  menu_row(frame.session, "view.tint", state.tint_by_slice);
  if (state.steering.present) ImGui::Separator();
  menu_row(frame.session, "steer.fly", state.steering.how.fly);
  menu_row(frame.session, "steer.invert-push", state.steering.how.invert_push);
  menu_row(frame.session, "steer.invert-turn", state.steering.how.invert_turn);
  ImGui::EndPopup();
}

}  // namespace

void draw_room_toolbar(RoomFrame& frame) {
  Session& session = frame.session;
  const ViewState& state = session.view();
  Chips chips(frame.rect, Chips::Corner::top_left);
  chips.next_row();
  command_chip(session, chips, "tool.move", "move", {}, state.tool == HandleTool::move);
  command_chip(session, chips, "tool.turn", "turn", {}, state.tool == HandleTool::turn);
  command_chip(session, chips, "tool.scale", "scale", {}, state.tool == HandleTool::scale);
  command_chip(session, chips, "tool.measure", "measure", {}, state.tool == HandleTool::measure);
  command_chip(session, chips, "tool.space", state.space == HandleSpace::sight ? "sight" : "axes",
               space_name(state.space), state.space == HandleSpace::sight);
  command_chip(session, chips, "tool.snap", "snap", {}, state.snap);
  command_chip(session, chips, "steer.selected", "move", "SpaceMouse", state.steering.moves_selected);
  ButtonStyle style;
  style.icon = "view";
  style.tip = {"Where from, and what is shown", {}, {}};
  if (chips.button("view", {}, style)) ImGui::OpenPopup("room-view");
  draw_view_menu(frame);
}

}  // namespace focalstage
