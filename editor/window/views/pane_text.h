#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include "core/compile/frame.h"
#include "core/optics/image_plan.h"
#include "core/schedule/schedule.h"
#include "editor/preview/pixel_reader.h"
#include "editor/window/base/pane.h"

struct ImDrawList;

namespace focalstage {

/// "left eye, -0.50 D", "both eyes, 0.00 D, surface light"
std::string image_words(const ImageSpec& spec);
/// "L -0.5"
std::string slot_label(const Slot& slot);
/// "left eye, -0.50 D, from 3.21 ms for 0.50 ms"
std::string slot_words(const Slot& slot);
/// What a pixel's reading says, a line each.
std::string pixel_words(glm::ivec2 pixel);
std::string point_words(const PixelReading& reading);
std::string slice_words(const SliceReading& slice);

/// A tooltip that follows the pointer, with the window's usual padding (panes have none).
class PaneTooltip {
 public:
  PaneTooltip();
  ~PaneTooltip();
  PaneTooltip(const PaneTooltip&) = delete;
  PaneTooltip& operator=(const PaneTooltip&) = delete;
};

/// Words in the middle of an empty pane.
void draw_hint(const PaneRect& rect, std::string_view words);

/// In the small font.
void small_text(ImDrawList& list, glm::vec2 at, std::string_view text, std::uint32_t colour);
glm::vec2 small_text_size(std::string_view text);

/// An image at an eighth of its size, three codes a pixel.
struct Thumbnail {
  glm::ivec2 size_px{0};
  std::vector<std::uint8_t> rgb;
};
Thumbnail thumbnail_of(const FrameImages& images, std::size_t image);

}  // namespace focalstage
