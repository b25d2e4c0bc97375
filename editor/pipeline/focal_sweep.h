#pragma once

#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "core/percept/focus_peak.h"
#include "core/percept/thing_look.h"
#include "core/percept/things.h"
#include "core/retina/retinas.h"

namespace focalstage {

/// Evenly spaced accommodations, in dioptres at the lens centre.
struct FocusRange {
  double from_d = 0.0;
  double to_d = 0.0;
  int count = 2;

  double at(int i) const { return i + 1 == count ? to_d : from_d + (to_d - from_d) * i / (count - 1); }
};

/// How everything looks at each focus of a range.
struct FocalSweep {
  std::vector<double> focus_d;
  std::vector<SeenThing> things;
  std::vector<std::vector<ThingLook>> looks;    ///< [focus][thing]
  std::vector<std::optional<FocusPeak>> peaks;  ///< of each thing's sharpness; none: it has no contrast
};

/// Gets each picture of the stack in turn; a fault ends the sweep.
using TakePicture = std::function<Status(int i, const RetinaImage& picture)>;

/// Looks as `view` says but with each focus of `range` in turn; what sharp would be is looked at once, through a
/// pinhole pupil, and `retinas` keep their maps over the stack. Faults: those of Retina and of `take`.
Result<FocalSweep> sweep_focus(Retinas& retinas, std::span<const RetinaInput> inputs, const RetinaView& view,
                               const ProjectorFlux& flux, const FocusRange& range, const TakePicture& take,
                               std::stop_token stop);

/// Of one thing over the sweep.
std::vector<double> sharpness_over(const FocalSweep& sweep, std::size_t thing);

}  // namespace focalstage
