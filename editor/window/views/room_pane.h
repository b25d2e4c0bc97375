#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "editor/window/base/pane.h"
#include "editor/window/views/room_hands.h"
#include "editor/window/views/room_overlay.h"
#include "editor/window/views/room_scene.h"

namespace focalstage {

/// The room: surfaces as lit, objects, viewer, projectors; what hands do with them.
class RoomPane : public Pane {
 public:
  std::string_view title() const override { return "Room"; }
  std::string_view icon() const override { return "room"; }
  bool dirty(const Session& session, glm::ivec2 size_px) const override;
  void render(const Session& session, glm::ivec2 size_px, double scale) override;
  void draw(Session& session, const PaneRect& rect) override;
  void finalize() override;

 private:
  using Clock = std::chrono::steady_clock;

  /// Everything that the picture depends on; a change of any means another picture.
  struct Shown {
    std::shared_ptr<const Stage> stage;
    std::shared_ptr<const CompiledSlices> slices;
    std::uint64_t revision = 0;
    RoomView view;
    LookThrough look_through = LookThrough::nothing;
    bool sheets = true;
    bool tint = false;
    bool conflict = false;

    bool operator==(const Shown&) const = default;
  };

  static Shown shown_of(const Session& session, glm::ivec2 size_px);
  /// Whether nothing has moved for a while: time for the fine picture.
  bool at_ease(const Session& session) const;

  std::unique_ptr<RoomScene> scene_ = std::make_unique<RoomScene>();
  RoomHands hands_;
  RoomOverlay overlay_;
  std::optional<Shown> shown_;  ///< what was rendered
  RoomView seen_view_;          ///< what was asked for last
  std::shared_ptr<const Stage> seen_stage_;
  bool at_rest_ = false;  ///< what is shown is the fine picture
  Clock::time_point moved_at_;
};

}  // namespace focalstage
