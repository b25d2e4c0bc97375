#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/calibrate/model_edges.h"
#include "core/optics/projector_model.h"

namespace focalstage {

/// What the projector shows so that every edge is lit where it stands: 8-bit gray from the top, lines a pixel wide.
/// `seen` says whether a place of an edge is lit from the projector; of an edge that is hidden in part only the rest is
/// drawn. Straight edges bend as the lens does.
std::vector<std::uint8_t> verify_picture(const ProjectorModel& model, const std::vector<WorldEdge>& edges,
                                         const std::function<bool(const glm::dvec3& world_m)>& seen);

}  // namespace focalstage
