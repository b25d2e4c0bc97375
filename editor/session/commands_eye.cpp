#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

#include "editor/session/command_list.h"

namespace focalstage {
namespace {

constexpr double farthest_head_m = 0.05;

/// args: focus_d; pupil_mm
Status focus(Session& session, const Value& args) {
  ViewState& view = session.view();
  view.focus_d = std::clamp(number_or(args, "focus_d", view.focus_d), -1.0, 10.0);
  view.pupil_mm = std::clamp(number_or(args, "pupil_mm", view.pupil_mm), 0.0, 8.0);
  return {};
}

template <int Steps>
Status nudge_focus(Session& session, const Value&) {
  session.view().focus_d = std::clamp(session.view().focus_d + 0.1 * Steps, -1.0, 10.0);
  return {};
}

Status conventional(Session& session, const Value& args) {
  session.view().conventional = flag_or(args, "on", !session.view().conventional);
  return {};
}

/// args: eye: left, right or red-cyan; none: the next of them
Status which(Session& session, const Value& args) {
  EyeShown& eye = session.view().eye;
  const std::string wanted = text_or(args, "eye", "");
  if (wanted == "left" || (wanted.empty() && eye == EyeShown::red_cyan)) {
    eye = EyeShown::left;
  } else if (wanted == "right" || (wanted.empty() && eye == EyeShown::left)) {
    eye = EyeShown::right;
  } else if (wanted == "red-cyan" || wanted.empty()) {
    eye = EyeShown::red_cyan;
  } else {
    return Fault{"command.argument", "eye", "is left, right or red-cyan", ""};
  }
  if (eye != EyeShown::red_cyan) session.view().side = eye == EyeShown::left ? Side::left : Side::right;
  return {};
}

/// args: x_m, y_m, z_m in the viewer's axes; none: back to where the images are made for
Status head(Session& session, const Value& args) {
  glm::dvec3 offset_m(number_or(args, "x_m", 0.0), number_or(args, "y_m", 0.0), number_or(args, "z_m", 0.0));
  const double length_m = glm::length(offset_m);
  if (length_m > farthest_head_m) offset_m *= farthest_head_m / length_m;
  session.view().head_offset_m = offset_m;
  return {};
}

}  // namespace

void add_eye_commands(CommandList& list) {
  const auto add = [&](Command command) { list.push_back(command); };
  add({"eye.focus", "Set focus and pupil", "", "", "", false, needs_project, focus});
  add({"eye.nearer", "Focus nearer", "]", "A tenth of a dioptre", "", true, needs_project, nudge_focus<1>});
  add({"eye.farther", "Focus farther", "[", "A tenth of a dioptre", "", true, needs_project, nudge_focus<-1>});
  add({"eye.conventional", "Conventional or multifocal", "C", "One slice at 0 D, as without the sweep", "compare", true,
       needs_project, conventional});
  add({"eye.which", "Left, right or red-cyan", "E", "Which eye the eye view shows", "eye", true, needs_project, which});
  add({"eye.head", "Move the head", "", "", "", false, needs_project, head});
}

}  // namespace focalstage
