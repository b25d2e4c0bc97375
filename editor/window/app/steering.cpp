#include "editor/window/app/steering.h"

#include <algorithm>
#include <string>

#include <glm/geometric.hpp>

#include "editor/session/thing.h"
#include "editor/tools/motion_steer.h"
#include "editor/tools/pose_edits.h"
#include "editor/window/views/room_frame.h"

namespace focalstage {
namespace {

// The first frame after a pause is not to leap by all of it.
constexpr double longest_step_s = 0.05;
// A hand that lets go for less is still at the same gesture.
constexpr double gesture_end_s = 0.25;
const glm::ivec2 any_size_px{100, 100};  // directions do not depend on it

HandMotion motion_of(const Deflection& deflection) { return {deflection.push, deflection.turn}; }

bool locked(const Project& project, const Thing& thing) {
  if (thing.list == "objects") {
    const Object* object = object_named(project, thing.name);
    return object != nullptr && object->locked;
  }
  const Surface* surface = thing.list == "surfaces" ? surface_named(project, thing.name) : nullptr;
  return surface != nullptr && surface->locked;
}

std::vector<HandleThing> selected_things(const Session& session) {
  const double time_s = session.view().frame / session.project().frames.rate_hz;
  std::vector<HandleThing> things;
  for (const Thing& thing : session.selection().things) {
    if (locked(session.project(), thing)) continue;
    if (auto handled = handle_thing(session.project(), thing.list, thing.name, time_s)) things.push_back(*handled);
  }
  return things;
}

std::string words_of(const std::vector<HandleThing>& things) {
  if (things.size() != 1) return "Move " + std::to_string(things.size()) + " things";
  return "Move " + title_of({things.front().list, things.front().name});
}

}  // namespace

bool Steering::wants_frame(const Session& session) const {
  return drags() || watch_.present() != session.view().steering.present || !motion_of(watch_.deflection()).rests();
}

void Steering::follow(Session& session, double delta_s, double now_s, bool hand_holds) {
  session.view().steering.present = watch_.present();
  const HandMotion motion = motion_of(watch_.deflection());
  const bool selects = session.view().steering.moves_selected;
  if (gesture_) {
    const bool over = motion.rests() && now_s - gesture_->moved_s > gesture_end_s;
    const bool other = !selects || hand_holds || !(gesture_->selection == session.selection());
    if (over || other) end(session);
  }
  if (motion.rests() || !session.has_document() || hand_holds) return;
  const double step_s = std::min(delta_s, longest_step_s);
  if (selects && !selected_things(session).empty()) {
    if (gesture_ || !session.dragging()) move_selected(session, step_s, now_s);
  } else {
    move_camera(session, step_s);
  }
}

void Steering::end(Session& session) {
  gesture_.reset();
  session.end_drag();
}

void Steering::move_camera(Session& session, double delta_s) const {
  ViewState& view = session.view();
  view.look_through = LookThrough::nothing;
  view.camera = steered(view.camera, motion_of(watch_.deflection()), view.steering.how, delta_s);
}

void Steering::move_selected(Session& session, double delta_s, double now_s) {
  if (!gesture_) {
    const std::vector<HandleThing> things = selected_things(session);
    gesture_ = Gesture{session.selection(), things, things, now_s};
  }
  const RoomView view = room_view(session, any_size_px);
  const glm::dvec3 middle_m =
      handle_frame(HandleSpace::world, gesture_->now, session.stage() ? session.stage()->world_from_viewer : Rigid())
          .origin_m;
  const double distance_m = glm::length(middle_m - view.world_from_camera.position_m);
  gesture_->now = carried(gesture_->now, view.world_from_camera.rotation, distance_m, motion_of(watch_.deflection()),
                          session.view().steering.how, delta_s);
  gesture_->moved_s = now_s;
  const double time_s = session.view().frame / session.project().frames.rate_hz;
  const auto edits_with = [&](HandleTool tool) {
    return drag_edits(session.project(), tool, gesture_->from, gesture_->now, false, time_s);
  };
  std::vector<Edit> edits = edits_with(HandleTool::turn);
  if (gesture_->from.size() == 1) {  // several turn about their middle, and change their places with that
    for (Edit& edit : edits_with(HandleTool::move)) edits.push_back(std::move(edit));
  }
  (void)session.drag(words_of(gesture_->from), std::move(edits));
}

}  // namespace focalstage
