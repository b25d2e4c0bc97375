#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <glm/vec2.hpp>

#include "editor/window/base/picture.h"
#include "editor/window/base/vtk_target.h"

namespace focalstage {

/// Where an image lies in a pane: so many screen pixels per image pixel, and which place of the image (in its pixels,
/// from its top left corner) lies in the middle of the pane.
struct ImagePlacement {
  double zoom = 1.0;
  glm::dvec2 centre_px{0.0};
  bool operator==(const ImagePlacement&) const = default;
};

/// The whole image, as large as fits into the pane.
ImagePlacement fitted(glm::ivec2 image_px, glm::dvec2 pane_px);

/// From pane pixels (from the pane's top left corner) to image pixels, and back.
glm::dvec2 image_from_pane(const ImagePlacement& placement, glm::dvec2 pane_px, glm::dvec2 at);
glm::dvec2 pane_from_image(const ImagePlacement& placement, glm::dvec2 pane_px, glm::dvec2 at);

/// An image as a VTK slice without interpolation: each code reaches the screen as it is.
class ImagePlane {
 public:
  explicit ImagePlane(bool smooth = false);
  ~ImagePlane();

  /// Rows from the top; 1 channel is shown gray, 3 as RGB.
  void set(glm::ivec2 size_px, int channels, std::span<const std::uint8_t> codes);
  void clear();
  glm::ivec2 size_px() const;

  void render(glm::ivec2 pane_px, const ImagePlacement& placement, double scale);
  Picture picture() const;
  void finalize();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace focalstage
