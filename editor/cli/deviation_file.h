#pragma once

#include <string>
#include <vector>

#include "core/stage/deviation.h"

namespace focalstage {

/// A thing in the room's metres as PLY, each vertex coloured by how far it went: blue for nothing over green and yellow
/// to red for `full_scale_m` and more.
std::string deviation_ply(const std::vector<Drawable>& drawables, const Deviation& deviation, double full_scale_m);

}  // namespace focalstage
