#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "core/compile/stack_plan.h"

namespace focalstage {

/// How far a slice's pixels lie beside the cells of the same number, in pixels: the lens' stretch less one times the
/// look.
glm::dvec2 shift_px(const LookTile& tile, const SliceSetup& slice, double lens_to_pupil_m);

/// Sets where the slices' pictures and the focuses of a tile lie, and which pixels its cells see. The plan's slices,
/// focuses and pupil must stand.
void set_optics(StackTile& tile, const LookTile& looks, const StackPlan& plan, const std::vector<SliceSetup>& slices,
                double lens_to_pupil_m);

}  // namespace focalstage
