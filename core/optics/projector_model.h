#pragma once

#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/rigid.h"
#include "core/scene/project.h"

namespace focalstage {

/// A projector as a camera: pinhole and OpenCV's distortion (k1 k2 p1 p2 k3 k4 k5 k6). Pixel i covers [i, i+1), its
/// centre is i + 0.5, the origin the top left corner; the projector looks along its -Z with +Y up.
struct ProjectorModel {
  int width_px = 0;
  int height_px = 0;
  glm::dvec2 focal_px{1.0};
  glm::dvec2 centre_px{0.0};
  std::vector<double> distortion;
  Rigid world_from_projector;

  bool operator==(const ProjectorModel&) const = default;
};

ProjectorModel projector_model(const Projector& projector);

/// The same view at `width_px` x `height_px` pixels: for previews at half or quarter size.
ProjectorModel resized(const ProjectorModel& model, int width_px, int height_px);

/// The tangent-plane position (projector-space x and y over the distance along -Z) that lands on `pixel`; undoes the
/// distortion by Newton's method to 1e-12. Where the distortion folds over and has no inverse: the nearest it found.
glm::dvec2 tangent_of_pixel(const ProjectorModel& model, const glm::dvec2& pixel);

/// The pixel on which a tangent-plane position lands.
glm::dvec2 pixel_of_tangent(const ProjectorModel& model, const glm::dvec2& tangent);

}  // namespace focalstage
