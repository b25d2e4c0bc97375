#pragma once

#include <functional>
#include <optional>

#include <glm/vec2.hpp>

#include "core/base/result.h"
#include "core/base/sides.h"
#include "core/retina/retina.h"
#include "io/show/reader.h"

namespace focalstage {

/// An eye that looks at a pattern as it really is, whatever the pattern's project says of it.
struct TrueEye {
  Side side = Side::left;
  double focus_d = 2.0;
  std::optional<double> lens_to_pupil_m;  ///< none: the project's
  double power_error_d = 0.0;             ///< what the lens really has beyond what was asked
  glm::dvec3 pupil_offset_m{0.0};         ///< from where the project has it, in the viewer's axes
};

/// What the retina gets of a frame, all exposures of a period.
struct SeenPattern {
  RetinaView view;
  RetinaImage image;

  /// Calls `take(look, light)` for every pixel.
  void each(const std::function<void(const glm::dvec2& look, double light)>& take) const;
};

/// `fov_deg` wide and high, about `gaze`. Faults of show and retina.
Result<SeenPattern> see_pattern(const ShowReader& show, std::size_t frame, const TrueEye& eye, double fov_deg,
                                const glm::dvec2& gaze = glm::dvec2(0.0));

/// What is said where a pattern is not there to be seen.
Fault nothing_seen(std::size_t frame, const std::string& what);

}  // namespace focalstage
