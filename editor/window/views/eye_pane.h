#pragma once

#include <memory>
#include <optional>

#include "editor/preview/preview_values.h"
#include "editor/window/base/pane.h"
#include "editor/window/views/image_plane.h"

namespace focalstage {

/// What an eye sees at a focus that a hand can set: either eye, both red-cyan or side by side; the sweep, a
/// conventional projection, or both; where vergence and accommodation part. The head can be moved a little.
class EyePane : public Pane {
 public:
  std::string_view title() const override { return "Eye"; }
  std::string_view icon() const override { return "eye"; }
  bool dirty(const Session& session, glm::ivec2 size_px) const override;
  void render(const Session& session, glm::ivec2 size_px, double scale) override;
  void draw(Session& session, const PaneRect& rect) override;
  void finalize() override;

 private:
  void draw_controls(Session& session, const PaneRect& rect);
  void draw_chips(Session& session, const PaneRect& rect);
  void draw_panels(const PaneRect& rect);
  void draw_conflicts(const Session& session, const PaneRect& rect);
  void draw_head(Session& session, const PaneRect& rect);
  void answer_mouse(Session& session, const PaneRect& rect);

  ImagePlane plane_{true};
  std::shared_ptr<const EyePicture> shown_;
  glm::ivec2 size_px_{0};
  std::optional<glm::vec2> asked_at_;  ///< where the hand asked for focus, in the pane
};

}  // namespace focalstage
