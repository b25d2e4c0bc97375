#pragma once

#include <string>

#include "core/schedule/sweep_shape.h"

namespace focalstage {

/// "response", "current", ...: as `focalstage shape --json` names it.
std::string name_of(ShapeLimit limit);

/// "harmonic", "A" or "D".
std::string unit_of(ShapeLimit limit);

/// What binds and by how much, in a sentence without a full stop.
std::string describe(const ShapeBound& bound);

}  // namespace focalstage
