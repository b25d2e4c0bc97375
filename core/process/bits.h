#pragma once

#include <vector>

#include "core/mesh/mesh.h"

namespace focalstage {

/// Which of bits that hang on nothing are small: their area is less than `least_share` of the largest one's.
std::vector<bool> small_bits(const std::vector<double>& areas_m2, double least_share);

/// Bits that hang on nothing go where their area is less than `least_share` of the largest one's.
Mesh without_bits(const Mesh& mesh, double least_share);

/// Sheets that hang on an edge which more than two triangles share go, the smallest first, where that leaves the edge
/// with two: fins, and walls inside. Where four meet (two bodies that touch) all stay.
Mesh without_fins(const Mesh& mesh);

/// One of the parts that a mesh falls into along its folds, numbered by area, the largest 0; among the parts whose
/// planes meet at less than `fold_deg`. Empty where there are not so many.
Mesh part_of(const Mesh& mesh, double fold_deg, int part);

}  // namespace focalstage
