#pragma once

#include <optional>

#include "core/schedule/schedule.h"
#include "editor/window/base/pane.h"
#include "editor/window/views/sweep_curves.h"

namespace focalstage {

struct SolveOffer;

/// One sweep: lens power, exposures, triggers, shutters and dead windows on one axis. Slices' powers can be dragged up
/// and down on it, and a moment chosen that all views follow. What the solver proposes shows beside what is there.
class TimePane : public Pane {
 public:
  std::string_view title() const override { return "Sweep"; }
  std::string_view icon() const override { return "time"; }
  bool dirty(const Session&, glm::ivec2) const override { return false; }  // drawn with the window, nothing of VTK's
  void render(const Session&, glm::ivec2, double) override {}
  void draw(Session& session, const PaneRect& rect) override;
  void finalize() override {}

 private:
  void draw_axes(const SweepAxes& axes) const;
  void draw_shutters(const SweepAxes& axes) const;
  void draw_slots(const SweepAxes& axes) const;
  void drag_slices(Session& session, const SweepAxes& axes);
  void draw_solve(Session& session, const PaneRect& rect) const;
  void scrub(Session& session, const SweepAxes& axes);
  void draw_reading(const SweepAxes& axes) const;

  std::optional<std::size_t> held_slice_;
};

}  // namespace focalstage
