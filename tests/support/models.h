#pragma once

#include "io/models/models.h"

namespace focalstage::support {

/// The models that come with the program, read once.
inline const ProjectorModels& models() {
  static const ProjectorModels shipped = *shipped_models();
  return shipped;
}

}  // namespace focalstage::support
