#pragma once

namespace focalstage {

/// How far behind its pupil an eye turns, and how well that is known of a person: centres of rotation are found 13 to
/// 15 mm behind the cornea, the pupil is seen 3 mm behind it. An eye that looks at something has its pupil on the way
/// there from this point.
inline constexpr double pupil_to_centre_m = 0.0105;
inline constexpr double pupil_to_centre_uncertainty_m = 0.001;

}  // namespace focalstage
