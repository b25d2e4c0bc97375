#pragma once

#include "core/compile/frame.h"
#include "core/stage/stage.h"
#include "tests/exact/forward_trace.h"

namespace focalstage::exact {

/// The plain numbers of a stage and its settings, for the forward trace. Objects must be unlit, flat or checkered;
/// their gray is the red channel's.
forward::Room room_of(const Stage& stage, const CompileSettings& settings);

}  // namespace focalstage::exact
