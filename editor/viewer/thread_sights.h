#pragma once

#include <filesystem>
#include <stop_token>
#include <vector>

#include "core/base/result.h"
#include "core/base/sides.h"
#include "editor/viewer/pattern.h"
#include "editor/viewer/seen_pattern.h"
#include "editor/viewer/two_choice.h"

namespace focalstage {

// Where an eye stands sideways, seen past a thread that hangs before it: the line on the surface that the eye sees
// behind the thread lies on the straight way through the thread from the eye's centre of rotation, because an eye that
// looks at the thread turns its pupil onto that way. Eyes that look straight ahead have their pupils as far apart as
// their centres: that is the interpupillary distance. Lines are shown at 0 D, where the lens turns no ray.

/// The lines as a project that any rig can show: frame k has the line behind the thread for the k-th place of an eye.
struct ThreadSights {
  Source source;
  std::vector<double> eye_x_mm;  ///< its centre of rotation for each frame, rising, in the viewer's axes
  Side eye = Side::left;
  double thread_m = 0.0;   ///< from the pupils along the gaze
  double surface_m = 0.0;  ///< the same of the surface, behind the thread
};

/// For a thread straight before the midpoint of the pupils. Faults "viewer.thread" where it does not hang between eyes
/// and surface, "viewer.surface", "viewer.refused", and those of the stage.
Result<ThreadSights> thread_sights(const Source& from, Side eye, double thread_m);

/// The test: "the line is left of the thread" is the first; places in millimetres.
Result<TwoChoiceTest> thread_test(const ThreadSights& sights, const std::filesystem::path& show,
                                  const FrameProgress& progress, const std::stop_token& stop);

/// How far left of the thread the line is, in radians, for an eye at `eye_x_mm` that looks at the thread.
Result<double> seen_thread_difference(const ShowReader& show, std::size_t frame, const ThreadSights& sights,
                                      double eye_x_mm);

/// What two runs of the test, one per eye, say.
struct InterpupillaryDistance {
  double mm = 0.0;
  double middle_mm = 0.0;       ///< how far the eyes' midpoint stands to the right of the thread
  double answers_mm = 0.0;      ///< one standard deviation, of the answers
  double thread_mm = 0.0;       ///< the same, of the thread's distance from where the eyes turn
  double uncertainty_mm = 0.0;  ///< of both
};
InterpupillaryDistance interpupillary_distance(const PerEye<EqualityEstimate>& eye_x_mm, const ThreadSights& sights,
                                               double thread_uncertainty_mm);

}  // namespace focalstage
