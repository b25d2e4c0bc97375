#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/optics/image_plan.h"
#include "core/schedule/shape_task.h"
#include "core/schedule/sweep_shape.h"

namespace focalstage {

/// How many samples a shaped period is stored as: 21 of the shortest harmonic's.
inline constexpr std::size_t shape_samples = 512;

/// What a project asks of its shaped sweep.
struct ShapeRules {
  ShapeTask task;
  LensLimits limits;
  ShapeBound harmonics;  ///< what ends them
};

/// Checks what cannot be shaped (see `shape_sweep`) and puts the rest in numbers. `project` sweeps a sine.
Result<ShapeRules> shape_rules(const Project& project, const std::vector<ImageSpec>& images,
                               const ShapeOptions& options);

/// The highest harmonic up to which every one is listed and can be driven; 0 where the first is not.
int measured_harmonics(const LensResponse& response);

}  // namespace focalstage
