#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/preview/preview_values.h"
#include "editor/session/view_state.h"
#include "editor/window/base/pane.h"
#include "editor/window/views/image_plane.h"

namespace focalstage {

/// The projector's images: one large, or the assignment of all in false colours, with the filmstrip of the sweep's
/// exposures below; the pixel under the hand explained.
class ProjectorPane : public Pane {
 public:
  std::string_view title() const override { return "Projector"; }
  std::string_view icon() const override { return "projector"; }
  bool dirty(const Session& session, glm::ivec2 size_px) const override;
  void render(const Session& session, glm::ivec2 size_px, double scale) override;
  void draw(Session& session, const PaneRect& rect) override;
  void finalize() override;

 private:
  /// Everything the picture depends on.
  struct Shown {
    const CompiledSlices* slices = nullptr;
    int image = 0;
    Side side = Side::left;
    ProjectorPicture picture = ProjectorPicture::slice;
    ShownBreathing compensation = ShownBreathing::on;
    ImagePlacement placement;
    glm::ivec2 size_px{0};
    bool operator==(const Shown&) const = default;
  };
  Shown wanted(const Session& session, glm::ivec2 size_px) const;
  ImagePlacement placement(const Session& session, glm::dvec2 area_px) const;
  void fill(const CompiledSlices& slices, const Shown& shown);
  void draw_chips(Session& session, const PaneRect& area);
  void draw_strip(Session& session, const PaneRect& rect);
  void answer_mouse(Session& session, const PaneRect& area);
  void draw_reading(const Session& session);
  static float strip_height(const PaneRect& rect);

  ImagePlane plane_;
  Shown shown_;
  std::shared_ptr<const CompiledSlices> held_;  ///< so that its address stays its own
  std::vector<std::unique_ptr<CodesTexture>> thumbnails_;
  const CompiledSlices* thumbnails_of_ = nullptr;
  std::optional<glm::dvec2> pan_from_px_;
};

}  // namespace focalstage
