#pragma once

#include <filesystem>
#include <stop_token>
#include <vector>

#include "core/base/result.h"
#include "core/base/sides.h"
#include "editor/pipeline/source.h"
#include "editor/viewer/pattern.h"
#include "editor/viewer/seen_pattern.h"
#include "editor/viewer/two_choice.h"

namespace focalstage {

// How far the lens stands from the pupil, seen by its breathing: a picture seen through more power is larger, and how
// much depends on that distance alone. Two half rings of one size for the eye, the upper one shown at the highest power
// of the project's slices and the lower at the lowest, meet only if they were made for the distance there is.

/// The rings as a project that any rig can show: frame k is made for the k-th distance.
struct BreathingRings {
  Source source;
  std::vector<double> lens_to_pupil_mm;  ///< of each frame, rising
  Side eye = Side::left;
  double surface_m = 0.0;  ///< from the pupil along the gaze
};

/// Angle between the gaze and the rings.
inline constexpr double ring_deg = 7.0;

/// The pattern for one eye of the project's viewer, on the project's surfaces and with its glasses, sweep, slices and
/// projector. Faults: "viewer.slices" where their powers are too near to each other to show a difference,
/// "viewer.surface" where no flat surface square to the gaze is there, and those of stage and assets.
Result<BreathingRings> breathing_rings(const Source& from, Side eye);

/// The test: the upper half is the first; distances in millimetres.
Result<TwoChoiceTest> ring_test(const BreathingRings& rings, const std::filesystem::path& show,
                                const FrameProgress& progress, const std::stop_token& stop);

/// How far apart the halves of a ring are for an eye: (upper - lower) over their mean, of the radii of what the retina
/// receives of the frame.
Result<double> seen_ring_difference(const ShowReader& show, std::size_t frame, const TrueEye& eye);

/// An eye that looks at the surface of the rings through glasses so far away.
TrueEye eye_at_rings(const BreathingRings& rings, double lens_to_pupil_mm);

}  // namespace focalstage
