#include "editor/window/panels/rig_menu.h"

#include <vector>

#include "editor/session/session.h"
#include "editor/window/base/fonts.h"
#include "editor/window/base/im.h"
#include "editor/window/base/number_text.h"
#include "editor/window/base/widgets.h"
#include "editor/window/panels/menu.h"

namespace focalstage {
namespace {

using Phase = RigStatus::Phase;

void connect(Session& session, const std::string& address) {
  Value args;
  args.set("address", address);
  (void)session.run("rig.connect", args);
  ImGui::CloseCurrentPopup();
}

std::string headline(const RigStatus& rig) {
  switch (rig.phase) {
    case Phase::none:
      return "No rig is connected";
    case Phase::connecting:
      return "Connecting to " + rig.address + "…";
    case Phase::lost:
      return "Lost " + rig.address;
    case Phase::connected:
      break;
  }
  if (rig.simulated) return "Simulated rig at " + rig.address;
  return (rig.description.name.empty() ? "Rig" : rig.description.name) + " at " + rig.address;
}

/// What it says of itself, in a line each.
std::vector<std::string> facts(const RigStatus& rig) {
  std::vector<std::string> lines;
  if (rig.phase == Phase::lost) lines.push_back("It is tried again until it answers or you disconnect.");
  if (rig.phase != Phase::connected) return lines;
  const RigState& state = rig.state;
  lines.push_back("Sweeps: " + std::to_string(state.sweeps) + ", late: " + std::to_string(state.late_sweeps) +
                  ", exposures missed: " + std::to_string(state.missed_exposures));
  if (state.temperature_c > 0.0) lines.push_back("Warmest part " + number_text(state.temperature_c, 0, "°C"));
  if (!state.holder.empty()) lines.push_back("Held by " + state.holder);
  return lines;
}

void draw_state(const RigStatus& rig) {
  ImGui::PushFont(strong_font());
  paragraph(headline(rig), rig.phase == Phase::lost ? theme::amber : theme::text);
  ImGui::PopFont();
  for (const std::string& line : facts(rig)) paragraph(line, theme::dim);
  if (!rig.state.fault.empty()) paragraph(rig.state.fault, theme::red);
  if (rig.fault && rig.phase != Phase::lost) paragraph(describe(*rig.fault), theme::red);
  if (rig.fault && rig.phase == Phase::lost) paragraph(describe(*rig.fault), theme::dim);
}

}  // namespace

void RigMenu::draw(Session& session, bool open, glm::vec2 min, glm::vec2 max) {
  if (open && address_.empty() && !session.recent_rigs().empty()) address_ = session.recent_rigs().front();
  if (!begin_menu("rig menu", open, min, max, px(340))) return;
  const NameScope scope("rig");
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {px(8), px(4)});
  ImGui::Indent(px(6));
  draw_state(session.rig().status());
  ImGui::Dummy({0.0f, px(2)});
  draw_address(session);
  ImGui::Unindent(px(6));
  ImGui::PopStyleVar();
  const std::vector<std::string> recent = session.recent_rigs();  // connecting changes the list
  for (const std::string& address : recent) {
    ListRowStyle style;
    style.icon = "history";
    style.tip.help = "Connect to " + address;
    if (menu_row(address, address, style)) connect(session, address);
  }
  menu_line();
  command_row(session, "rig.simulate");
  command_row(session, "rig.adopt");
  command_row(session, "rig.disconnect");
  end_menu();
}

void RigMenu::draw_address(Session& session) {
  const ButtonStyle style;
  const float button_width = button_size("Connect", style).x;
  FieldStyle field;
  field.hint = "HOST:PORT";
  field.width_px = ImGui::GetContentRegionAvail().x - button_width - px(12);
  field.tip.help = "Where the rig's runtime listens";
  const bool entered = text_field("address", address_, field).entered;
  ImGui::SameLine(0.0f, px(6));
  ButtonStyle press;
  if (address_.empty()) press.tip.unavailable = "type an address first";
  const bool pressed = button("Connect", press);
  if ((entered || pressed) && !address_.empty()) connect(session, address_);
}

}  // namespace focalstage
