#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/scene/project.h"

namespace focalstage {

/// Something that may be other than the project says: the project as it really is then.
struct RigError {
  std::string what;     ///< "viewer along x", "screen turned about y"
  double amount = 1.0;  ///< a small one, in `unit`
  std::string unit;
  std::function<void(Project&, double amount)> make;
  double power_d = 0.0;  ///< of the lens, beside what it is told, for each unit
  double late_s = 0.0;   ///< of the light, for each unit
};

/// All that may be off in a project: viewer, each surface that is shown and the first projector by 1 mm along and 1
/// degree about each of their own axes, tracked objects as well, the lens by 0.1 D, its distance from the pupil and the
/// eyes' from each other by 1 mm, and the light by 1 ms where something moves.
std::vector<RigError> rig_errors(const Project& project);

/// By how much something is off: `RigError::what`, in its unit.
using ErrorAmounts = std::map<std::string, double>;

/// A rig in which several things are off at once.
struct RealRig {
  Project project;       ///< where things really are
  double power_d = 0.0;  ///< of the lens, beside what it is told
  double late_s = 0.0;   ///< of the light
};

/// What `amounts` names and `rig_errors` does not have (a surface that is gone) is as the project says.
RealRig real_rig(const Project& project, const ErrorAmounts& amounts);

}  // namespace focalstage
