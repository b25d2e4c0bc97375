#pragma once

#include <memory>
#include <optional>

#include <imgui.h>

#include "editor/session/session.h"
#include "editor/tools/room_view.h"
#include "editor/tools/sight_frame.h"
#include "editor/window/base/pane.h"
#include "editor/window/views/room_scene.h"

namespace focalstage {

/// One frame of the room pane, as its parts see it. Pixels of the view count from the pane's upper left corner.
struct RoomFrame {
  Session& session;
  RoomScene& scene;
  RoomView view;
  PaneRect rect;
  double scale = 1.0;

  /// The room as it stands now: a drag in this very frame may have moved things.
  const Stage& stage() const {
    static const Stage nothing;
    return session.stage() ? *session.stage() : nothing;
  }
  const std::vector<Fixture>& fixtures() const { return scene.fixtures(session); }

  ImVec2 on_window(const glm::dvec2& pixel) const {
    return {rect.min.x + static_cast<float>(pixel.x), rect.min.y + static_cast<float>(pixel.y)};
  }
  glm::dvec2 in_view(const ImVec2& window) const {
    return {static_cast<double>(window.x - rect.min.x), static_cast<double>(window.y - rect.min.y)};
  }
  SightFrame sight() const { return sight_frame(session.project(), stage()); }
  double time_s() const { return session.view().frame / session.project().frames.rate_hz; }
  /// By camera, not through an eye or a projector.
  bool has_camera() const { return session.view().look_through == LookThrough::nothing; }
};

/// What the room is seen with: its camera, or an eye or the projector one looks through.
RoomView room_view(const Session& session, glm::ivec2 size_px);

}  // namespace focalstage
