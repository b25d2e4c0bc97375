#pragma once

#include <string>

#include "core/rig_measure/measurement.h"
#include "core/scene/value.h"

namespace focalstage {

/// What a rig measured of itself, as the object that `--json` prints: each value with its spread.
Value value_of(const RigMeasurement& measurement);

/// The same as a table, for people.
std::string measurement_table(const RigMeasurement& measurement);

}  // namespace focalstage
