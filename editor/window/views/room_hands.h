#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "editor/tools/depth_handle.h"
#include "editor/tools/handle_drag.h"
#include "editor/tools/handle_shapes.h"
#include "editor/tools/typed_numbers.h"
#include "editor/window/views/room_frame.h"

namespace focalstage {

/// The depth of the object whose properties are shown.
struct RoomDepth {
  std::string object;
  DepthReading reading;
  std::optional<DepthSheet> sheet;
};

/// What hands do in the room: pick, drag handles and the depth sheet, orbit, pan, zoom, measure. What it leaves in its
/// members is what the overlay shows of it.
class RoomHands {
 public:
  /// `hovered`: the pointer is over the picture itself. `pressed`: it went down there, and has not come up.
  void follow(RoomFrame& frame, bool hovered, bool pressed);

  /// Whether the picture is being moved by a hand right now.
  bool busy() const { return hold_ != Hold::none && hold_ != Hold::press; }

  std::vector<HandleThing> things;   ///< what the handles act on
  HandleFrame handle_frame;          ///< where `things` is not empty
  std::vector<HandleShape> handles;  ///< none: nothing to hold
  std::optional<Handle> hot_handle;  ///< under the pointer, or held
  std::optional<RoomDepth> depth;
  bool hot_sheet = false;
  std::optional<StagedName> hot_thing;
  std::string amount;  ///< of the drag, in words; empty: none
  std::optional<std::pair<glm::dvec2, glm::dvec2>> box_px;
  std::vector<glm::dvec3> measure_m;  ///< up to two points; while one is set, the second is under the pointer
  bool measuring = false;             ///< the second point is not fixed yet

  /// Where the depth sheet is held: above its upper edge.
  static std::optional<glm::dvec2> sheet_knob_px(const RoomFrame& frame, const DepthSheet& sheet);

 private:
  enum class Hold { none, orbit, pan, press, box, handle, depth };

  void see_things(RoomFrame& frame);
  void see_depth(RoomFrame& frame);
  void see_hot(RoomFrame& frame, const glm::dvec2& pixel);
  void begin(RoomFrame& frame, const glm::dvec2& pixel);
  void go_on(RoomFrame& frame, const glm::dvec2& pixel);
  void end(RoomFrame& frame, const glm::dvec2& pixel);
  void leave_press(RoomFrame& frame, const glm::dvec2& pixel);
  void drag_handle(RoomFrame& frame, const glm::dvec2& pixel);
  void drag_depth(RoomFrame& frame, const glm::dvec2& pixel);
  bool is_news(const glm::dvec2& pixel);
  void hold_handle(RoomFrame& frame, Handle handle, const glm::dvec2& pixel);
  void take_keys(RoomFrame& frame);
  void cancel(RoomFrame& frame);
  void click(RoomFrame& frame, const glm::dvec2& pixel);
  void focus_here(RoomFrame& frame, const glm::dvec2& pixel);
  void wheel(RoomFrame& frame, const glm::dvec2& pixel);
  std::optional<PickHit> pick(RoomFrame& frame, const glm::dvec2& pixel) const;

  Hold hold_ = Hold::none;
  glm::dvec2 start_px_{0.0};
  glm::dvec2 last_px_{0.0};
  std::optional<StagedName> pressed_on_;
  HandleDrag handle_drag_;
  DepthDrag depth_drag_;
  TypedNumbers typed_;
  bool done_by_keys_ = false;  ///< Enter or Escape ended the drag; the button is still down
  bool made_step_ = false;
  std::string asked_;  ///< what the last step of the drag was made from: a hand that rests makes no more of them
  std::shared_ptr<const Stage> depth_stage_;
};

}  // namespace focalstage
