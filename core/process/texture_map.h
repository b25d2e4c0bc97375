#pragma once

#include <glm/mat4x4.hpp>

#include "core/base/result.h"
#include "core/mesh/mesh.h"
#include "core/scene/process.h"

// New texture coordinates in place of those that a mesh has or lacks. `room_from_mesh`: the thing's own axes, in metres
// of the room. What looks away from the picture gets it too, mirrored.
namespace focalstage {

/// "process.edge-on": the mesh has no width or no height as seen along the plane's normal, so that nothing can fit it.
Result<Mesh> mapped_by_plane(const Mesh& mesh, const UvPlaneStep& step, const glm::dmat4& room_from_mesh);

/// Between corners texture coordinates are straight, a projector's are not: edges are cut in two until the picture is
/// nowhere further off than `most_stray_px`, as far as they can lie in it. The shape stays what it was.
/// "process.behind-projector": a triangle reaches nearer than `nearest_thrown_m` before the projector;
/// "process.too-large": beyond `most_processed_triangles`.
Result<Mesh> mapped_by_projector(const Mesh& mesh, const UvProjectorStep& step, const glm::dmat4& room_from_mesh);

inline constexpr double most_stray_px = 0.25;
inline constexpr double nearest_thrown_m = 1e-3;

}  // namespace focalstage
