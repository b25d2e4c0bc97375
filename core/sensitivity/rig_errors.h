#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/scene/project.h"

namespace focalstage {

/// Something that may be other than the project says, by a small amount: the project as it really is then.
struct RigError {
  std::string what;     ///< "viewer x", "screen turned about y"
  double amount = 1.0;  ///< in `unit`
  std::string unit;
  std::function<void(Project&)> make;
  double power_d = 0.0;  ///< of the lens, beside what it is told
  double late_s = 0.0;   ///< of the light
};

/// All that may be off in a project: viewer, each surface that is shown and the first projector by 1 mm along and 1
/// degree about each of their own axes, tracked objects as well, the lens by 0.1 D, its distance from the pupil and the
/// eyes' from each other by 1 mm, and the light by 1 ms where something moves.
std::vector<RigError> rig_errors(const Project& project);

}  // namespace focalstage
