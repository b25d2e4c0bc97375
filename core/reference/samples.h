#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/base/result.h"
#include "core/base/sides.h"
#include "core/compile/frame.h"
#include "core/optics/assignment.h"
#include "core/optics/eye.h"
#include "core/reference/view.h"
#include "core/stage/stage.h"

namespace focalstage {

/// Where a ray of the projector ends.
struct LitPoint {
  glm::dvec3 world_m{0.0};
  double depth_m = 0.0;     ///< from the projector, along its -Z
  std::size_t face = 0;     ///< in the views of the surfaces, which list faces alike
  std::size_t surface = 0;  ///< in the stage's list
  glm::dvec3 shares{0.0};   ///< the parts the face's corners have in it
};

/// The same point as one eye sees it.
struct EyePoint {
  glm::dvec3 point_m{0.0};   ///< in eye space
  glm::dvec3 normal{0.0};    ///< of its face, in eye space; not unit
  glm::dvec2 straight{0.0};  ///< the look straight at it
  double surface_m = 0.0;    ///< axial from the lens centre: what stretches its looks
};

/// What one slice shows there.
struct SliceSample {
  glm::dvec2 look{0.0};
  std::size_t object = 0;  ///< in the stage's list
  double weight = 0.0;
  double beyond_d = 0.0;  ///< how far the wanted power lies beyond the outermost slice
  glm::dvec3 colour{0.0};
  bool below = false;     ///< the wanted power lies below the lowest slice, not above the highest
  double wanted_d = 0.0;  ///< the power that would put it where it is wanted; a pinned slice's own
};

/// The chain from a projector pixel to the light of a slice, link by link and for any place in the raster. Design
/// section 5 read aloud; stage and settings must outlive it.
class Samples {
 public:
  static Result<Samples> of(const Stage& stage, const CompileSettings& settings);

  std::optional<LitPoint> lit(const glm::dvec2& pixel) const;

  /// None where another surface hides the point, or where it lies nearer than the lens.
  std::optional<EyePoint> seen(Side side, const LitPoint& lit) const;

  /// None where the look meets no object.
  std::optional<SliceSample> slice(Side side, const EyePoint& eye, std::size_t n) const;

  /// What share of the light there comes back, by colour.
  glm::dvec3 albedo(const LitPoint& lit) const;

  /// The area, on the plane of the face, that the pixel about that place in the raster covers.
  double footprint_m2(const glm::dvec2& pixel, const LitPoint& lit) const;

  const Eye& eye(Side side) const { return eyes_[side]; }

 private:
  Samples(const Stage& stage, const CompileSettings& settings, View from_projector);

  std::optional<glm::dvec2> look(const EyePoint& eye, std::size_t n) const;

  const Stage* stage_;
  const CompileSettings* settings_;
  SliceRule rule_;
  PerEye<Eye> eyes_;
  View from_projector_;                        ///< the surfaces
  std::vector<View> surfaces_;                 ///< from each eye
  std::vector<View> objects_;                  ///< from each eye
  PerEye<std::vector<double>> part_depths_m_;  ///< planar breathing only
};

}  // namespace focalstage
