#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/rigid.h"
#include "core/reference/sight.h"
#include "core/stage/stage.h"

namespace focalstage {

/// A triangle of the stage: which drawable of which surface or object, and which face of its mesh.
struct Face {
  std::size_t thing = 0;  ///< in the stage's surfaces or objects
  std::size_t drawable = 0;
  std::size_t triangle = 0;
};

/// The surfaces or the objects of a stage as seen from one point.
struct View {
  std::vector<Face> faces;
  std::vector<SeenTriangle> corners_m;  ///< of each face, in the space of who looks
  Sight sight;

  glm::dvec3 normal(std::size_t face) const;  ///< not unit
};

Result<View> view_of(const std::vector<StagedSurface>& surfaces, const Rigid& view_from_world, double nearest_m);
Result<View> view_of(const std::vector<StagedObject>& objects, const Rigid& view_from_world, double nearest_m);

/// For each face of the surfaces' view, in its order: how far the centre of its smooth part lies along -Z.
std::vector<double> part_depths_m(const std::vector<StagedSurface>& surfaces, const Rigid& view_from_world);

}  // namespace focalstage
