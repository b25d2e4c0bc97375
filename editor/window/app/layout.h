#pragma once

#include <array>
#include <optional>
#include <vector>

#include "editor/window/base/pane.h"

namespace focalstage {

/// Where the splitters stand, as the person left them. Lengths in design pixels, shares of the centre 0..1.
struct Splits {
  double outline = 220.0;
  double properties = 290.0;
  double bottom = 150.0;
  double across = 0.5;  ///< between the left and the right views
  double down = 0.57;   ///< between the upper and the lower views

  bool operator==(const Splits&) const = default;
};

/// A gap between two parts that can be dragged.
struct Splitter {
  enum class Kind { outline, properties, bottom, across, down };
  Kind kind;
  PaneRect rect;
  bool vertical;  ///< a vertical line: dragged left and right
};

/// Every part of the window in pixels. Parts that don't fit are left out rather than squeezed: first the bottom and
/// the timeline, then properties, then the outline; a view too small for itself gives its place to its neighbour.
struct Layout {
  PaneRect bar;
  std::optional<PaneRect> outline;
  std::optional<PaneRect> properties;
  std::optional<PaneRect> timeline;
  std::optional<PaneRect> bottom;
  PaneRect centre;
  std::array<std::optional<PaneRect>, 4> views;  ///< by PaneId
  std::vector<Splitter> splitters;
};

/// `scale`: pixels per design pixel. `filled`: the one view that fills the centre. `with_timeline`: it has something
/// to show.
Layout lay_out(glm::ivec2 size_px, double scale, const Splits& splits, std::optional<int> filled, bool with_timeline);

/// The splits after that splitter was dragged to the pointer; kept within what the window can show.
Splits dragged(const Layout& layout, Splits splits, Splitter::Kind kind, glm::vec2 pointer_px, double scale);

}  // namespace focalstage
