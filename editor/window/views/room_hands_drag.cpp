// What a hand that holds something does from frame to frame.
#include <algorithm>
#include <utility>

#include <imgui.h>
#include <imgui_internal.h>

#include <glm/geometric.hpp>

#include "core/base/number_words.h"
#include "editor/tools/pose_edits.h"
#include "editor/window/views/room_hands.h"

namespace focalstage {
namespace {

constexpr double still_px = 4.0;  ///< a press that moves less is a click
constexpr double depth_snap_d = 0.1;

std::string subject(const std::vector<HandleThing>& things) {
  if (things.size() != 1) return std::to_string(things.size()) + " things";
  return title_of({things.front().list, things.front().name});
}

std::string verb(HandleTool tool) {
  return tool == HandleTool::turn ? "Turn " : tool == HandleTool::scale ? "Scale " : "Move ";
}

DragWish wish_of(const ViewState& state) {
  DragWish wish;
  wish.snap = state.snap != ImGui::GetIO().KeyCtrl;  // Ctrl: the other way for as long as it is held
  wish.snap_m = state.snap_m;
  wish.snap_deg = state.snap_deg;
  wish.keep_angular_size = ImGui::GetIO().KeyShift;
  return wish;
}

bool key_pressed(ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); }

}  // namespace

void RoomHands::hold_handle(RoomFrame& frame, Handle handle, const glm::dvec2& pixel) {
  hold_ = Hold::handle;
  hot_handle = handle;
  handle_drag_ = drag_start(frame.session.view().tool, handle, handle_frame, frame.view, pixel,
                            frame.stage().world_from_viewer, things);
}

/// A press that has begun to move: an object goes with the hand, anything else opens a box.
void RoomHands::leave_press(RoomFrame& frame, const glm::dvec2& pixel) {
  const ViewState& state = frame.session.view();
  if (state.tool == HandleTool::measure) return;
  const bool on_object = pressed_on_ && pressed_on_->list == "objects" && state.tool == HandleTool::move;
  if (!on_object || ImGui::GetIO().KeyCtrl) {
    hold_ = Hold::box;
    return;
  }
  const Thing thing{pressed_on_->list, pressed_on_->name};
  if (!frame.session.selection().has(thing)) frame.session.select({thing});
  see_things(frame);
  if (things.empty()) return;
  hold_handle(frame, Handle::view, start_px_);
  drag_handle(frame, pixel);
}

/// Whether pointer, typed numbers or held keys differ from when this was last asked.
bool RoomHands::is_news(const glm::dvec2& pixel) {
  const ImGuiIO& io = ImGui::GetIO();
  std::string asks = fixed_text(pixel.x, 2) + " " + fixed_text(pixel.y, 2) + (io.KeyShift ? " shift " : " ") +
                     (io.KeyCtrl ? "ctrl " : "") + typed_.text();
  const bool differs = asks != asked_;
  asked_ = std::move(asks);
  return differs;
}

void RoomHands::drag_handle(RoomFrame& frame, const glm::dvec2& pixel) {
  if (!is_news(pixel)) return;
  const DragWish wish = wish_of(frame.session.view());
  const Dragged dragged =
      typed_.empty() ? drag_to(handle_drag_, pixel, wish) : drag_by(handle_drag_, typed_.numbers(), wish);
  amount = dragged.amount;
  // Along the sight the size may follow (Shift): its key is set in every step, whether it does or not.
  const bool with_size = handle_drag_.frame.space == HandleSpace::sight && handle_drag_.handle == Handle::z;
  const std::vector<Edit> edits = drag_edits(frame.session.project(), handle_drag_.tool, handle_drag_.things,
                                             dragged.things, with_size, frame.time_s());
  if (!made_step_ && dragged.things == handle_drag_.things) return;
  made_step_ = frame.session.drag(verb(handle_drag_.tool) + subject(handle_drag_.things), edits).ok() || made_step_;
}

void RoomHands::drag_depth(RoomFrame& frame, const glm::dvec2& pixel) {
  if (!is_news(pixel)) return;
  const bool snap = frame.session.view().snap != ImGui::GetIO().KeyCtrl;
  double vergence_d = vergence_dragged_d(depth_drag_, pixel, snap ? depth_snap_d : 0.0);
  const std::vector<double> numbers = typed_.numbers();
  if (!numbers.empty()) vergence_d = std::clamp(1.0 / std::max(numbers.front(), 1e-6), 0.05, 20.0);  // metres
  amount = fixed_text(1.0 / vergence_d, 3) + " m, " + fixed_text(vergence_d, 2) + " D";
  if (!made_step_ && numbers.empty() && glm::length(pixel - start_px_) < still_px) return;
  made_step_ = frame.session.drag("Focus " + depth_drag_.object, {depth_edit(depth_drag_.object, vergence_d)}).ok() ||
               made_step_;
}

/// Back to where it was: the drag's own step is undone, so that History shows nothing of it.
void RoomHands::cancel(RoomFrame& frame) {
  const bool had_step = made_step_;
  frame.session.end_drag();
  if (had_step) (void)frame.session.run("edit.undo");
  made_step_ = false;
  done_by_keys_ = true;
  amount.clear();
  box_px.reset();
}

void RoomHands::take_keys(RoomFrame& frame) {
  if (hold_ != Hold::handle && hold_ != Hold::depth && hold_ != Hold::box) return;
  ImGui::GetCurrentContext()->WantTextInputNextFrame = 1;  // digits are numbers now, not commands
  if (key_pressed(ImGuiKey_Escape)) {
    cancel(frame);
    return;
  }
  for (const ImWchar character : ImGui::GetIO().InputQueueCharacters) {
    if (character < 128) typed_.type(static_cast<char>(character));
  }
  if (key_pressed(ImGuiKey_Backspace)) typed_.backspace();
  if (key_pressed(ImGuiKey_Enter) && !typed_.empty()) {
    if (hold_ == Hold::handle) drag_handle(frame, last_px_);
    if (hold_ == Hold::depth) drag_depth(frame, last_px_);
    frame.session.end_drag();
    done_by_keys_ = true;
  }
}

void RoomHands::go_on(RoomFrame& frame, const glm::dvec2& pixel) {
  const glm::dvec2 moved_px = pixel - last_px_;
  take_keys(frame);
  if (done_by_keys_) return;
  ViewState& state = frame.session.view();
  switch (hold_) {
    case Hold::orbit:
      if (moved_px == glm::dvec2(0.0)) break;
      state.look_through = LookThrough::nothing;
      state.camera = orbited(state.camera, moved_px, 0.4 / frame.scale);
      break;
    case Hold::pan:
      if (frame.has_camera()) state.camera = panned(state.camera, frame.view.size_px, moved_px);
      break;
    case Hold::press:
      if (glm::length(pixel - start_px_) > still_px * frame.scale) leave_press(frame, pixel);
      break;
    case Hold::handle:
      drag_handle(frame, pixel);
      break;
    case Hold::depth:
      drag_depth(frame, pixel);
      break;
    case Hold::box:
      box_px = {start_px_, pixel};
      break;
    case Hold::none:
      break;
  }
  last_px_ = pixel;
}

}  // namespace focalstage
