#pragma once

#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/rigid.h"
#include "core/scene/project.h"

namespace focalstage {

/// A projector as a camera: pinhole and OpenCV's distortion (k1 k2 p1 p2 k3 k4 k5 k6). Pixel i covers [i, i+1), its
/// centre is i + 0.5, the origin the top left corner; the projector looks along its -Z with +Y up.
///
/// Pixels are counted by column and row; where they lie is a *place* in the picture, in steps from column to column and
/// from row to row, and the pinhole is about places. On a square lattice pixel and place are one. On a diamond one
/// (TI's DLP4500) the pixels of an odd row lie half a column further to the right: place = pixel + (0.5, 0). Rows are
/// half as far apart there as columns, so that fy is twice fx for a lens that does not stretch.
struct ProjectorModel {
  int width_px = 0;
  int height_px = 0;
  glm::dvec2 focal_px{1.0};
  glm::dvec2 centre_px{0.0};
  std::vector<double> distortion;
  Rigid world_from_projector;
  PixelLayout layout = PixelLayout::square;

  bool operator==(const ProjectorModel&) const = default;
};

ProjectorModel projector_model(const Projector& projector);

/// The same view at `width_px` x `height_px` pixels: for previews at half or quarter size. They are of a square lattice
/// whatever the whole one is, with as many pixels: what is smaller than a pixel of a preview, its half steps are too.
ProjectorModel resized(const ProjectorModel& model, int width_px, int height_px);

/// Where a spot of a pixel lies, and the pixel at a place: each pixel is a rectangle of one column by one row.
glm::dvec2 place_of_pixel(const ProjectorModel& model, const glm::dvec2& pixel);
glm::dvec2 pixel_of_place(const ProjectorModel& model, const glm::dvec2& place);

/// The tangent-plane position (projector-space x and y over the distance along -Z) that lands on `place`; undoes the
/// distortion by Newton's method to 1e-12. Where the distortion folds over and has no inverse: the nearest it found.
glm::dvec2 tangent_of_place(const ProjectorModel& model, const glm::dvec2& place);

/// The place at which a tangent-plane position lands: smooth over the whole picture, as the pixel is not.
glm::dvec2 place_of_tangent(const ProjectorModel& model, const glm::dvec2& tangent);

/// The same for pixels, which is how light leaves a projector: whoever asks which pixel lights what asks here.
glm::dvec2 tangent_of_pixel(const ProjectorModel& model, const glm::dvec2& pixel);
glm::dvec2 pixel_of_tangent(const ProjectorModel& model, const glm::dvec2& tangent);

/// Where a world point lands; none where it is not in front of the projector, by a micrometre.
std::optional<glm::dvec2> pixel_of_world(const ProjectorModel& model, const glm::dvec3& world_m);

}  // namespace focalstage
