#pragma once

#include <optional>

#include "core/schedule/schedule.h"
#include "editor/window/base/pane.h"

namespace focalstage {

/// One sweep: lens power, exposures, triggers, shutters and dead windows on one axis. Slices' powers can be dragged up
/// and down on it, and a moment chosen that all views follow.
class TimePane : public Pane {
 public:
  std::string_view title() const override { return "Sweep"; }
  std::string_view icon() const override { return "time"; }
  bool dirty(const Session&, glm::ivec2) const override { return false; }  // drawn with the window, nothing of VTK's
  void render(const Session&, glm::ivec2, double) override {}
  void draw(Session& session, const PaneRect& rect) override;
  void finalize() override {}

 private:
  struct Axes;
  void draw_axes(const Axes& axes) const;
  void draw_shutters(const Axes& axes) const;
  void draw_slots(const Axes& axes) const;
  void draw_powers(const Axes& axes, const Sweep& sweep) const;
  void drag_slices(Session& session, const Axes& axes);
  void scrub(Session& session, const Axes& axes);
  void draw_reading(const Axes& axes) const;

  std::optional<std::size_t> held_slice_;
};

}  // namespace focalstage
