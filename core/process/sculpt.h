#pragma once

#include <optional>

#include "core/base/result.h"
#include "core/mesh/mesh.h"
#include "core/scene/process.h"

// The steps that OpenMesh makes. Where vertices in one place have one texture coordinate they are one; borders, and
// seams of the texture, are borders to all of them. Normals, where there were some, are made anew: creases of 45
// degrees or more stay sharp.
namespace focalstage {

/// Down to `triangles`, or as far as no vertex that goes is further than `error_m` from what is left, by quadric errors
/// (Garland and Heckbert, 1997). Borders stay as they are; no triangle turns by more than 30 degrees at once.
Mesh decimated(const Mesh& mesh, std::optional<std::size_t> triangles, std::optional<double> error_m);

/// So many rounds of moving each vertex towards its neighbours. Borders stay, and so do edges whose triangles meet at
/// `feature_deg` or more.
Mesh smoothed(const Mesh& mesh, int rounds, double feature_deg);

/// Each round makes four triangles of one (Loop, 1987) or three (sqrt 3: Kobbelt, 2000); texture coordinates and
/// colours go through the same weights. "process.too-large" beyond `most_processed_triangles`.
Result<Mesh> subdivided(const Mesh& mesh, Subdivision scheme, int rounds);

inline constexpr std::size_t most_processed_triangles = std::size_t{1} << 24;

}  // namespace focalstage
