#pragma once

#include "devices/roles/rig.h"
#include "io/protocol/rig_values.h"

namespace focalstage {

/// A part of the rig as the state tells it.
inline PartReport report_of(const RigPart& part) {
  return {{part.id.driver, part.id.model, part.id.serial, part.id.address},
          name_of(part.state.phase),
          part.state.fault ? describe(*part.state.fault) : std::string()};
}

}  // namespace focalstage
