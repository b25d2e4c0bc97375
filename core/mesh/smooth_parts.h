#pragma once

#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/mesh/mesh.h"

namespace focalstage {

inline constexpr double cos_30_deg = 0.86602540378443864676;

/// A mesh cut along its folds. Triangles hang together across an edge of equal positions where their planes meet at
/// an angle whose cosine is above `cos_fold`, 30 degrees unless said otherwise; parts are numbered by their first
/// triangle. The planar breathing mode takes each part's centre for its distance (design section 4).
struct SmoothParts {
  std::vector<std::uint32_t> part_of_triangle;
  std::vector<glm::dvec3> centre_m;  ///< area-weighted; of a part without area the mean of its corners
  std::vector<double> area_m2;
};

/// Areas and centres in mesh space.
SmoothParts smooth_parts(const Mesh& mesh, double cos_fold = cos_30_deg);

/// The same parts with areas and centres as they stand in the world; the cut itself stays as it is.
SmoothParts placed(const SmoothParts& parts, const Mesh& mesh, const glm::dmat4& world_from_mesh);

}  // namespace focalstage
