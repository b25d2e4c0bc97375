#pragma once

#include "core/base/sides.h"
#include "core/compile/frame.h"
#include "core/percept/things.h"
#include "core/retina/retina.h"
#include "core/schedule/schedule.h"
#include "core/schedule/seen.h"
#include "core/stage/stage.h"

namespace focalstage {

// Compiler, scheduler and retina know nothing of each other; here what two of them made becomes what the third takes.

/// The glasses as they are worn, which may be slower than those that the show was timed for.
struct WornGlasses {
  ShutterSpeed shutter;
  double lens_aperture_m = 0.016;

  bool operator==(const WornGlasses&) const = default;
};

WornGlasses worn_glasses(const Glasses& glasses);

/// Of the project's first projector.
ProjectorFlux flux_of(const Project& project);

/// All that reaches the eye of `side` in one period: every exposure through the power of its lens and what its shutter
/// lets through meanwhile, the other eye's too where it leaks. Stage and images must outlive the result.
RetinaInput seen_frame(const Stage& stage, const CompileSettings& settings, const FrameImages& images,
                       const Schedule& schedule, const WornGlasses& glasses, Side side);

}  // namespace focalstage
