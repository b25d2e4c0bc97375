#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "editor/window/app/layout.h"
#include "editor/window/base/pane.h"
#include "editor/window/base/panel.h"

namespace focalstage {

class FramePainter;
class Session;

/// What a frame of the window is to show.
struct WorkbenchFrame {
  glm::ivec2 size_px{0};
  double scale = 1.0;
  bool open = true;           ///< a document is: views; else the start panel
  std::optional<int> filled;  ///< the view that fills the centre
  bool render_views = true;   ///< false: their last pictures
};

/// The parts of the window in their places: panels, views, the splitters between them.
class Workbench {
 public:
  Workbench(std::vector<std::unique_ptr<Panel>> panels, std::array<std::unique_ptr<Pane>, 4> panes, Splits splits);

  /// Renders views that changed, as many as one frame has time for, then draws everything.
  void draw(Session& session, const WorkbenchFrame& frame, FramePainter& painter);

  /// Whether a view still waits to be rendered.
  bool unsettled() const { return unsettled_; }

  /// The view whose fill button was pressed in this frame.
  std::optional<int> take_fill_press();

  const Splits& splits() const { return splits_; }
  bool moving_splitter() const { return moving_.has_value(); }

  void finalize();

 private:
  struct View {
    std::unique_ptr<Pane> pane;
    bool rendered = false;
    bool hovered = false;
  };

  void draw_splitters(const WorkbenchFrame& frame);
  void render_views(Session& session, const WorkbenchFrame& frame, FramePainter& painter);
  bool view_is_dirty(const Session& session, std::size_t index) const;
  void draw_view(Session& session, std::size_t index, const WorkbenchFrame& frame);
  void draw_view_corners(std::size_t index, const PaneRect& rect, bool filled);
  void draw_panel(Session& session, Panel& panel, const PaneRect& rect);
  void draw_place(Session& session, PanelPlace place, const std::optional<PaneRect>& rect);
  void draw_bottom(Session& session, const PaneRect& rect);
  bool has(PanelPlace place) const;

  std::vector<std::unique_ptr<Panel>> panels_;
  std::array<View, 4> views_;
  Splits splits_;
  Layout layout_;
  std::optional<Splitter::Kind> moving_;
  std::optional<int> fill_press_;
  std::size_t next_view_ = 0;
  bool unsettled_ = true;
};

}  // namespace focalstage
