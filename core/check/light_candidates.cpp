#include <algorithm>
#include <cmath>

#include "core/check/candidates.h"

namespace focalstage {

Candidates clipped_candidates(const Project& project, const Measured& measured) {
  const Compensation& asked = project.slices.compensation;
  if (asked.mode == CompensationMode::off) return {};
  double most = 0.0;
  for (const FrameMeasure& frame : measured.frames) {
    for (const SurfaceAsked& surface : frame.surfaces) most = std::max(most, surface.most);
  }
  Candidates candidates;
  // Light grows no faster than white does, less what leaks: so much less of it is enough.
  const double reachable = std::floor(asked.white / most * 1000.0) / 1000.0;
  if (most > 1.0 && reachable > 0.0)
    candidates.push_back({{set_edit("slices", "", "compensation/white", Value(reachable))}});
  candidates.push_back({{set_edit("slices", "", "compensation/mode", Value("off"))}, true});
  return candidates;
}

}  // namespace focalstage
