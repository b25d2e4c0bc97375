#pragma once

#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "core/stage/stage.h"

namespace focalstage {

/// From one end to the other, in the world.
using WorldEdge = std::pair<glm::dvec3, glm::dvec3>;

/// What one sees of the shape of a stage's surfaces from `from_m`: rims, folds of more than 20 degrees, and outlines,
/// where a face that is turned towards one meets one that is turned away. Hidden ones too; each once. Corners are the
/// same where they lie in one place.
std::vector<WorldEdge> model_edges(const std::vector<StagedSurface>& surfaces, const glm::dvec3& from_m);

}  // namespace focalstage
