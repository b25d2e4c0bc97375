#pragma once

#include "core/base/result.h"
#include "core/compile/frame.h"
#include "core/stage/stage.h"

namespace focalstage {

/// The same images by the shortest way from the formulas: one ray per sample, eye and slice (Embree). Slow, shares with
/// the engine only the values it takes and returns and core/optics; every sample and random scene is held against it.
Result<CompiledFrame> compile_reference(const Stage& stage, const CompileSettings& settings, int threads = 0);

}  // namespace focalstage
