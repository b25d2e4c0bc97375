#include "editor/window/views/room_pane.h"

#include <imgui.h>

#include "editor/session/session.h"
#include "editor/window/base/frame_wish.h"
#include "editor/window/base/theme.h"
#include "editor/window/views/room_toolbar.h"

namespace focalstage {
namespace {

/// So long after the last change the picture is made again, twice as fine.
constexpr std::chrono::milliseconds still_for{140};
/// No finer than that in all: on a large display the pixels are small enough.
constexpr double most_pixels = 3.2e6;

}  // namespace

RoomPane::Shown RoomPane::shown_of(const Session& session, glm::ivec2 size_px) {
  const ViewState& state = session.view();
  return {session.stage(),    session.slices(),  session.revision(),  room_view(session, size_px),
          state.look_through, state.show_sheets, state.tint_by_slice, state.conflict};
}

bool RoomPane::at_ease(const Session& session) const {
  return !hands_.busy() && !session.dragging() && !session.view().playing && Clock::now() - moved_at_ >= still_for;
}

bool RoomPane::dirty(const Session& session, glm::ivec2 size_px) const {
  if (!scene_) return false;
  return !shown_ || *shown_ != shown_of(session, size_px) || scene_->has_news() || (!at_rest_ && at_ease(session));
}

void RoomPane::render(const Session& session, glm::ivec2 size_px, double scale) {
  if (!scene_) return;
  const Shown wanted = shown_of(session, size_px);
  scene_->take(session);
  at_rest_ = at_ease(session);
  const double pixels = 4.0 * static_cast<double>(size_px.x) * static_cast<double>(size_px.y);
  scene_->render(wanted.view, session, at_rest_ && pixels <= most_pixels ? 2 : 1, scale);
  shown_ = wanted;
}

void RoomPane::draw(Session& session, const PaneRect& rect) {
  if (!scene_) return;
  draw_picture(scene_->picture(), rect.min, rect.size);
  const glm::ivec2 size_px(rect.size + 0.5f);
  if (size_px.x < 1 || size_px.y < 1) return;
  ImGui::SetCursorScreenPos({rect.min.x, rect.min.y});
  ImGui::InvisibleButton(
      "picture", {rect.size.x, rect.size.y},
      ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
  ImGui::SetItemAllowOverlap();  // chips lie over it
  RoomFrame frame{session, *scene_, room_view(session, size_px), rect, ui_scale()};
  hands_.follow(frame, ImGui::IsItemHovered(), ImGui::IsItemActive());
  frame.view = room_view(session, size_px);  // the hand may have moved it
  if (frame.view != seen_view_ || session.stage() != seen_stage_) {
    seen_view_ = frame.view;
    seen_stage_ = session.stage();
    moved_at_ = Clock::now();
  }
  overlay_.draw(frame, hands_);
  draw_room_toolbar(frame);
  if (!at_rest_ || scene_->waits_for_meshes()) want_frame_within(std::chrono::duration<double>(still_for).count());
}

void RoomPane::finalize() {
  if (!scene_) return;
  scene_->finalize();
  scene_.reset();
}

}  // namespace focalstage
