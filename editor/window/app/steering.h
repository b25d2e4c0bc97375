#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "devices/input/motion_watch.h"
#include "editor/session/session.h"
#include "editor/tools/handle_frame.h"

namespace focalstage {

/// A SpaceMouse in the editor: steers the room's camera or, where that is wished, what is selected. A gesture, from
/// where the hand takes hold until it has let go for a moment, is one step of undo.
class Steering {
 public:
  /// `wake`: from any thread, when a hand moves it.
  Steering(std::unique_ptr<MotionInput> input, std::function<void()> wake)
      : watch_(std::move(input), std::move(wake)) {}

  /// Whether a frame would move something, or find the device come or gone.
  bool wants_frame(const Session& session) const;

  /// One frame's worth of it. `hand_holds`: a hand on the pointer moves something right now, and goes first.
  void follow(Session& session, double delta_s, double now_s, bool hand_holds);

  /// A gesture is under way: the drag of the session is this one's.
  bool drags() const { return gesture_.has_value(); }

 private:
  struct Gesture {
    Selection selection;
    std::vector<HandleThing> from;
    std::vector<HandleThing> now;
    double moved_s = 0.0;
  };

  void end(Session& session);
  void move_camera(Session& session, double delta_s) const;
  void move_selected(Session& session, double delta_s, double now_s);

  MotionWatch watch_;
  std::optional<Gesture> gesture_;
};

}  // namespace focalstage
