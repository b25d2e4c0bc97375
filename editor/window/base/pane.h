#pragma once

#include <string_view>

#include <glm/vec2.hpp>

namespace focalstage {

class Session;

/// Where a pane lies in the window, in ImGui's pixels.
struct PaneRect {
  glm::vec2 min{0.0f};
  glm::vec2 size{0.0f};
};

/// One of the views of the centre. Each frame: `render` if it is dirty, then `draw` inside its ImGui window.
class Pane {
 public:
  virtual ~Pane() = default;

  virtual std::string_view title() const = 0;
  virtual std::string_view icon() const = 0;

  /// Whether what it shows differs from what was last rendered at `size_px`. Cheap: compares revisions and states.
  virtual bool dirty(const Session& session, glm::ivec2 size_px) const = 0;

  /// Renders its VTK picture. Nothing of ImGui here. `scale`: the window's content scale (lines, points).
  virtual void render(const Session& session, glm::ivec2 size_px, double scale) = 0;

  /// Draws the picture and what lies over it (labels, handles, controls), and answers the mouse while the pane is
  /// hovered or owns a drag, by commands, edits and changes of the view state.
  virtual void draw(Session& session, const PaneRect& rect) = 0;

  /// Releases what belongs to the GL context; called before the window goes.
  virtual void finalize() = 0;
};

}  // namespace focalstage
