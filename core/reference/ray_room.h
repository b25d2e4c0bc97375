#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/result.h"
#include "core/stage/stage.h"

namespace focalstage {

/// Where a ray meets a surface.
struct RayHit {
  double along = 0.0;        ///< lengths of the ray
  std::size_t surface = 0;   ///< in the stage's list
  std::size_t drawable = 0;  ///< of it
  std::size_t triangle = 0;  ///< of its mesh
  glm::dvec3 shares{0.0};    ///< the parts the triangle's corners have in the point
};

/// The surfaces of a stage, to be met by rays from anywhere. Embree's own triangles, in float about the first point of
/// the stage's triangles: good to a millionth of the room.
class RayRoom {
 public:
  /// Fault "reference.embree".
  static Result<RayRoom> of(const std::vector<StagedSurface>& surfaces);

  /// How many lengths of `along` from `from_m` the first triangle lies, both sides, beyond `beyond` lengths.
  std::optional<double> first(const glm::dvec3& from_m, const glm::dvec3& along, double beyond) const;

  /// The same meeting, with all that is known of it.
  std::optional<RayHit> hit(const glm::dvec3& from_m, const glm::dvec3& along, double beyond) const;

  /// Whether nothing stands on the way from `from_m` to `to_m`, its last thousandth left out.
  bool free(const glm::dvec3& from_m, const glm::dvec3& to_m) const;

 private:
  struct State;
  explicit RayRoom(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  std::shared_ptr<const State> state_;
};

}  // namespace focalstage
