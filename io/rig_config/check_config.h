#pragma once

#include "io/rig_config/rig_config.h"

namespace focalstage {

/// What a schema cannot say: "rig.config", with the JSON pointer in `where`.
Status check_config(const RigConfig& config);

}  // namespace focalstage
