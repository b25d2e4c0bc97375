#include <algorithm>
#include <array>
#include <string_view>
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

/// args: projection: multifocal, conventional or both; on: conventional or not; none: the other of the two
Status conventional(Session& session, const Value& args) {
  EyeProjection& projection = session.view().projection;
  const std::string wanted = text_or(args, "projection", "");
  const bool on = flag_or(args, "on", projection != EyeProjection::conventional);
  if (wanted == "both") {
    projection = EyeProjection::both;
  } else if (wanted.empty() || wanted == "conventional" || wanted == "multifocal") {
    const bool one = wanted.empty() ? on : wanted == "conventional";
    projection = one ? EyeProjection::conventional : EyeProjection::multifocal;
  } else {
    return Fault{"command.argument", "projection", "is multifocal, conventional or both", ""};
  }
  return {};
}

Status beside(Session& session, const Value& args) {
  EyeProjection& projection = session.view().projection;
  const bool on = flag_or(args, "on", projection != EyeProjection::both);
  projection = on ? EyeProjection::both : EyeProjection::multifocal;
  return {};
}

Status conflict(Session& session, const Value& args) {
  session.view().conflict = flag_or(args, "on", !session.view().conflict);
  return {};
}

constexpr std::array<std::pair<std::string_view, EyeLook>, 4> looks{{{"left", EyeLook::left},
                                                                     {"right", EyeLook::right},
                                                                     {"red-cyan", EyeLook::red_cyan},
                                                                     {"side-by-side", EyeLook::side_by_side}}};

/// args: eye: left, right, red-cyan or side-by-side; none: the next of them
Status which(Session& session, const Value& args) {
  EyeLook& eye = session.view().eye;
  const std::string wanted = text_or(args, "eye", "");
  const auto named = std::find_if(looks.begin(), looks.end(), [&](const auto& look) { return look.first == wanted; });
  if (wanted.empty()) {
    eye = looks[(static_cast<std::size_t>(eye) + 1) % looks.size()].second;
  } else if (named != looks.end()) {
    eye = named->second;
  } else {
    return Fault{"command.argument", "eye", "is left, right, red-cyan or side-by-side", ""};
  }
  if (eye == EyeLook::left) session.view().side = Side::left;
  if (eye == EyeLook::right) session.view().side = Side::right;
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

/// args: what, amount in its unit (none: as the project says); without `what`: all as the project says
Status off_rig(Session& session, const Value& args) {
  constexpr double most = 10.0;  // times what a study of sensitivity takes
  ErrorAmounts& amounts = session.view().rig_errors;
  const std::string what = text_or(args, "what", "");
  if (what.empty()) {
    amounts.clear();
    return {};
  }
  for (const RigError& error : rig_errors(session.project())) {
    if (error.what != what) continue;
    const double amount = std::clamp(number_or(args, "amount", 0.0), -most * error.amount, most * error.amount);
    if (amount == 0.0) amounts.erase(what);
    if (amount != 0.0) amounts[what] = amount;
    return {};
  }
  return Fault{"command.argument", "what", "nothing of this project is called " + what, "see check --sensitivity"};
}

}  // namespace

void add_eye_commands(CommandList& list) {
  const auto add = [&](Command command) { list.push_back(command); };
  add({"eye.focus", "Set focus and pupil", "", "", "", false, needs_project, focus});
  add({"eye.nearer", "Focus nearer", "]", "A tenth of a dioptre", "", true, needs_project, nudge_focus<1>});
  add({"eye.farther", "Focus farther", "[", "A tenth of a dioptre", "", true, needs_project, nudge_focus<-1>});
  add({"eye.conventional", "Conventional or multifocal", "C", "One slice at 0 D, as without the sweep", "compare", true,
       needs_project, conventional});
  add({"eye.beside", "Multifocal beside conventional", "Shift+C", "Both at once, at the same focus", "compare", true,
       needs_project, beside});
  add({"eye.conflict", "Show the vergence-accommodation conflict", "V",
       "Red: the focus lies further away than the eyes converge; blue: nearer; green: within 0.5 D", "exchange", true,
       needs_project, conflict});
  add({"eye.which", "Left, right, red-cyan or side by side", "E", "Which eye the eye view shows", "eye", true,
       needs_project, which});
  add({"eye.head", "Move the head", "", "", "", false, needs_project, head});
  add({"eye.off-rig", "See a rig that is off", "", "", "", false, needs_project, off_rig});
}

}  // namespace focalstage
