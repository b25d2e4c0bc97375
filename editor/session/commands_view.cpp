#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "editor/session/command_list.h"

namespace focalstage {
namespace {

/// Where the room's camera looks from.
template <int Azimuth, int Elevation>
Status stand(Session& session, const Value&) {
  session.view().camera.azimuth_deg = Azimuth;
  session.view().camera.elevation_deg = Elevation;
  session.view().look_through = LookThrough::nothing;
  return {};
}

Status home(Session& session, const Value&) {
  SessionAccess::of(session).fit_views();
  session.view().look_through = LookThrough::nothing;
  return {};
}

template <LookThrough Through>
Status look(Session& session, const Value&) {
  LookThrough& now = session.view().look_through;
  now = now == Through ? LookThrough::nothing : Through;
  return {};
}

template <bool ViewState::*Flag>
Status toggle(Session& session, const Value& args) {
  session.view().*Flag = flag_or(args, "on", !(session.view().*Flag));
  return {};
}

template <HandleTool Tool>
Status use(Session& session, const Value&) {
  session.view().tool = Tool;
  return {};
}

Status space(Session& session, const Value&) {
  HandleSpace& now = session.view().space;
  now = now == HandleSpace::world   ? HandleSpace::local
        : now == HandleSpace::local ? HandleSpace::sight
                                    : HandleSpace::world;
  return {};
}

template <PaneId Pane>
Status fill(Session& session, const Value&) {
  auto& filled = session.view().filled;
  if (filled == Pane) {
    filled.reset();
  } else {
    filled = Pane;
  }
  return {};
}

Status four(Session& session, const Value&) {
  session.view().filled.reset();
  return {};
}

enum class Tab { findings, history, log };

template <Tab Shown>
Status bottom(Session& session, const Value&) {
  static constexpr std::array<const char*, 3> names{"findings", "history", "log"};
  session.view().bottom_tab = names[static_cast<std::size_t>(Shown)];
  return {};
}

/// args: image, in the image plan
Status image(Session& session, const Value& args) {
  const auto number = number_arg(args, "image");
  if (!number) return number.fault();
  session.view().image = static_cast<int>(std::clamp(*number, 0.0, 1e4));
  session.view().picture = ProjectorPicture::slice;
  return {};
}

Status assignment(Session& session, const Value&) {
  auto& picture = session.view().picture;
  picture = picture == ProjectorPicture::slice ? ProjectorPicture::assignment : ProjectorPicture::slice;
  return {};
}

Status compensation(Session& session, const Value&) {
  auto& now = session.view().compensation;
  now = now == ShownBreathing::on    ? ShownBreathing::off
        : now == ShownBreathing::off ? ShownBreathing::difference
                                     : ShownBreathing::on;
  return {};
}

Status palette(Session& session, const Value&) {
  auto& state = SessionAccess::of(session);
  state.palette_open = !state.palette_open;
  return {};
}

/// args: time_s from the period's start; none: the whole sweep again
Status scrub(Session& session, const Value& args) {
  const auto time_s = number_arg(args, "time_s");
  session.view().sweep_time_s.reset();
  if (time_s) session.view().sweep_time_s = std::clamp(*time_s, 0.0, 1.0 / session.project().sweep.frequency_hz);
  return {};
}

}  // namespace

void add_view_commands(CommandList& list) {
  const auto add = [&](Command command) { list.push_back(command); };
  add({"app.palette", "Find a command", "Ctrl+P", "Every command, by its name", "search", false, always, palette});
  add({"view.home", "Everything in view", "Shift+Home", "Everything in view, as at the start", "home", true,
       needs_project, home});
  add({"view.front", "Room from the viewer", "1", "Along the viewer's gaze", "", true, needs_project, stand<0, 0>});
  add({"view.right", "Room from the right", "3", "From the viewer's right", "", true, needs_project, stand<-90, 0>});
  add({"view.top", "Room from the top", "7", "Straight down", "", true, needs_project, stand<0, 90>});
  add({"view.left-eye", "Look through the left eye", "", "The room as the left eye has it", "eye", true, needs_project,
       look<LookThrough::left_eye>});
  add({"view.right-eye", "Look through the right eye", "", "The room as the right eye has it", "eye", true,
       needs_project, look<LookThrough::right_eye>});
  add({"view.projector", "Look through the projector", "", "The room as the projector lights it", "projector", true,
       needs_project, look<LookThrough::projector>});
  add({"view.sheets", "Image planes", "P", "Where each slice's picture floats", "slice", true, needs_project,
       toggle<&ViewState::show_sheets>});
  add({"view.frusta", "Frusta", "", "What projectors reach", "", true, needs_project, toggle<&ViewState::show_frusta>});
  add({"view.tint", "Tint by slice", "T", "Each part of an object in the colour of its slice", "tint", true,
       needs_project, toggle<&ViewState::tint_by_slice>});
  add({"tool.move", "Move", "G", "Handles that move", "move", true, needs_project, use<HandleTool::move>});
  add({"tool.turn", "Turn", "R", "Handles that turn", "turn", true, needs_project, use<HandleTool::turn>});
  add({"tool.scale", "Scale", "S", "Handles that scale", "scale", true, needs_project, use<HandleTool::scale>});
  add({"tool.measure", "Measure", "U", "Metres, dioptres and degrees between two points", "measure", true,
       needs_project, use<HandleTool::measure>});
  add({"tool.space", "World, local or sight axes", "X", "The axes of the handles; sight is what depth means here",
       "axes", true, needs_project, space});
  add({"tool.snap", "Snap", "Shift+S", "Moves in steps", "snap", true, needs_project, toggle<&ViewState::snap>});
  add({"view.fill-room", "Fill with the room", "F1", "The room alone, or all four views", "room", true, needs_project,
       fill<PaneId::room>});
  add({"view.fill-projector", "Fill with the projector", "Shift+F2", "The projector's images alone, or all four views",
       "projector", true, needs_project, fill<PaneId::projector>});
  add({"view.fill-eye", "Fill with the eye", "F3", "The eye alone, or all four views", "eye", true, needs_project,
       fill<PaneId::eye>});
  add({"view.fill-time", "Fill with the sweep", "F4", "The sweep alone, or all four views", "time", true, needs_project,
       fill<PaneId::time>});
  add({"view.four", "All four views", "F5", "", "four", true, needs_project, four});
  add({"view.findings", "Show the findings", "", "What is wrong with the project", "finding", true, needs_project,
       bottom<Tab::findings>});
  add({"view.history", "Show the history", "", "All steps, to go back to any of them", "history", true, needs_project,
       bottom<Tab::history>});
  add({"view.log", "Show the log", "", "What happened since the start", "log", true, needs_project, bottom<Tab::log>});
  add({"projector.image", "Show an image", "", "", "", false, needs_project, image});
  add({"projector.assignment", "Assignment in false colours", "A", "Which slice lights each pixel", "tint", true,
       needs_project, assignment});
  add({"projector.compensation", "Breathing compensation on, off, difference", "B",
       "What compensation does to the images", "difference", true, needs_project, compensation});
  add({"sweep.scrub", "Go to a moment of the sweep", "", "", "", false, needs_project, scrub});
}

}  // namespace focalstage
