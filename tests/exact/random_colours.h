#pragma once

#include "tests/exact/random_scene.h"

namespace focalstage::exact {

/// The same room with surfaces that have colours, a projector that leaks and whose codes were measured, and codes that
/// make up for some of it.
RandomScene coloured(RandomScene scene);

}  // namespace focalstage::exact
