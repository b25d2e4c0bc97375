#pragma once

#include <memory>
#include <vector>

#include <glm/mat4x4.hpp>

#include "core/base/result.h"
#include "core/mesh/mesh.h"
#include "core/scene/process.h"

namespace focalstage {

/// The mesh after all steps, in order. `scale`: how much larger it stands in the room than in its file; the lengths of
/// steps are the room's. `thing_from_mesh`: where it lies in its file. Codes "process.*": a step that cannot be done,
/// or leaves no triangle; the place is the step in the list and its setting, "/2/rounds".
Result<Mesh> processed(const Mesh& mesh, const std::vector<ProcessStep>& steps, double scale = 1.0,
                       const glm::dmat4& thing_from_mesh = glm::dmat4(1.0));

/// The same, kept: the 32 last asked for are the same mesh when asked for again. Any thread; two that ask for the same
/// at once wait for one to make it.
Result<std::shared_ptr<const Mesh>> processed_once(const std::shared_ptr<const Mesh>& mesh,
                                                   const std::vector<ProcessStep>& steps, double scale = 1.0,
                                                   const glm::dmat4& thing_from_mesh = glm::dmat4(1.0));

}  // namespace focalstage
