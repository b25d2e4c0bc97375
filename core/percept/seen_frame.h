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

/// Of the project's first projector, whose light the room's is weighed against.
ProjectorFlux flux_of(const Project& project);

/// What else there is to see by, and what it is weighed against.
struct RoomLight {
  double ambient_lux = 0.0;  ///< on every surface, all the time
  ProjectorFlux flux;
};

RoomLight room_light_of(const Project& project);

/// The room's light on white, in full codes of one whole exposure of `white_lux` (while it is on), through the lens
/// powers that pass while the shutter of `side` lets it in. None where there is none or the projector's brightness is
/// not known.
std::vector<PowerShare> ambient_shares(const Schedule& schedule, const WornGlasses& glasses, Side side,
                                       const RoomLight& room, double white_lux);

/// All that reaches the eye of `side` in one period: every exposure through the power of its lens and what its shutter
/// lets through meanwhile, the other eye's too where it leaks. Stage and images must outlive the result.
/// Light thins with distance and angle where codes make up for that, else it falls alike on all surfaces.
RetinaInput seen_frame(const Stage& stage, const CompileSettings& settings, const FrameImages& images,
                       const Schedule& schedule, const WornGlasses& glasses, Side side, const RoomLight& room = {});

}  // namespace focalstage
