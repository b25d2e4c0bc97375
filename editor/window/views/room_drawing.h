#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <imgui.h>

#include "editor/window/views/room_frame.h"

namespace focalstage {

/// Draws lines and words of the room over its picture, clipped to the pane, each label at most once in a place.
class RoomDrawing {
 public:
  explicit RoomDrawing(const RoomFrame& frame);
  ~RoomDrawing();
  RoomDrawing(const RoomDrawing&) = delete;
  RoomDrawing& operator=(const RoomDrawing&) = delete;

  /// A line between two points of the room; the part before the near plane is left out.
  void line(const glm::dvec3& a_m, const glm::dvec3& b_m, std::uint32_t colour, double width_px = 1.0);
  void dashes(const glm::dvec3& a_m, const glm::dvec3& b_m, std::uint32_t colour, double width_px = 1.0);

  /// Words on a chip whose lower middle stands above `pixel`; left out where they would cover another label. True if
  /// drawn.
  bool label(const glm::dvec2& pixel, std::string_view words, std::uint32_t colour, bool always = false);
  /// Words without a chip, centred; never left out.
  void words(const glm::dvec2& pixel, std::string_view text, std::uint32_t colour);

  ImDrawList& list() { return list_; }

 private:
  struct Box {
    ImVec2 min;
    ImVec2 max;
  };

  const RoomFrame& frame_;
  ImDrawList& list_;
  std::vector<Box> taken_;
};

}  // namespace focalstage
