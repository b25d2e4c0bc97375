#pragma once

#include <memory>
#include <vector>

#include "editor/tools/outline.h"
#include "editor/window/views/room_drawing.h"
#include "editor/window/views/room_frame.h"
#include "editor/window/views/room_hands.h"

namespace focalstage {

/// What lies over the room's picture: lines of sight and light, outlines, names, handles, the depth sheet, measures.
class RoomOverlay {
 public:
  void draw(const RoomFrame& frame, const RoomHands& hands);

 private:
  void draw_outlines(const RoomFrame& frame, const RoomHands& hands, RoomDrawing& drawing);

  /// Outlines cost a millisecond or two: made again only when they could differ.
  struct Traced {
    std::shared_ptr<const Stage> stage;
    RoomView view;
    StagedName thing;
    std::vector<Outline> lines;
  };
  const std::vector<Outline>& traced(const RoomFrame& frame, const StagedName& thing);
  std::vector<Traced> traced_;
};

}  // namespace focalstage
