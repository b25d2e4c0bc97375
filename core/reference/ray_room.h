#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "core/base/result.h"
#include "core/stage/stage.h"

namespace focalstage {

/// The surfaces of a stage, to be met by rays from anywhere. Embree's own triangles, in float about the first point of
/// the stage's triangles: good to a millionth of the room.
class RayRoom {
 public:
  /// Fault "reference.embree".
  static Result<RayRoom> of(const std::vector<StagedSurface>& surfaces);

  /// How many lengths of `along` from `from_m` the first triangle lies, both sides, beyond `beyond` lengths.
  std::optional<double> first(const glm::dvec3& from_m, const glm::dvec3& along, double beyond) const;

  /// Whether nothing stands on the way from `from_m` to `to_m`, its last thousandth left out.
  bool free(const glm::dvec3& from_m, const glm::dvec3& to_m) const;

 private:
  struct State;
  explicit RayRoom(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  std::shared_ptr<const State> state_;
};

}  // namespace focalstage
