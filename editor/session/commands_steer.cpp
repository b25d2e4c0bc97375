#include <algorithm>
#include <string>

#include "editor/session/command_list.h"

namespace focalstage {
namespace {

constexpr double per_step = 1.25;

bool present(const Session& session) { return session.view().steering.present; }

std::string needs_input(const Session& session) {
  if (!present(session)) return "No SpaceMouse is plugged in.";
  return needs_project(session);
}

Status selected(Session& session, const Value& args) {
  bool& now = session.view().steering.moves_selected;
  now = flag_or(args, "on", !now);
  return {};
}

template <bool SteerSettings::*Flag>
Status toggle(Session& session, const Value& args) {
  bool& now = session.view().steering.how.*Flag;
  now = flag_or(args, "on", !now);
  return {};
}

Status set_sensitivity(Session& session, double sensitivity) {
  session.view().steering.how.sensitivity = std::clamp(sensitivity, least_sensitivity, most_sensitivity);
  return {};
}

Status faster(Session& session, const Value&) {
  return set_sensitivity(session, session.view().steering.how.sensitivity * per_step);
}

Status slower(Session& session, const Value&) {
  return set_sensitivity(session, session.view().steering.how.sensitivity / per_step);
}

}  // namespace

void add_steer_commands(CommandList& list) {
  const auto add = [&](Command command) {
    command.shown = present;
    list.push_back(command);
  };
  add({"steer.selected", "Move selected with SpaceMouse", "", "What is selected goes with the hand, else the room does",
       "move", true, needs_input, selected});
  add({"steer.fly", "Fly with the SpaceMouse", "", "The hand is the camera, else it holds the room", "view", true,
       needs_input, toggle<&SteerSettings::fly>});
  add({"steer.invert-push", "Invert the SpaceMouse's pushes", "", "Right is left, up is down, near is far", "", true,
       needs_input, toggle<&SteerSettings::invert_push>});
  add({"steer.invert-turn", "Invert the SpaceMouse's turns", "", "Turns go the other way", "", true, needs_input,
       toggle<&SteerSettings::invert_turn>});
  add({"steer.faster", "SpaceMouse faster", "", "By a quarter", "", true, needs_input, faster});
  add({"steer.slower", "SpaceMouse slower", "", "By a fifth", "", true, needs_input, slower});
}

}  // namespace focalstage
