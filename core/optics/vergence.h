#pragma once

#include "core/scene/project.h"

namespace focalstage {

/// The pupil that decompositions are made for, where nobody says otherwise: about that of an eye that looks at a lit
/// screen of 100 cd/m2 in a dim room (Watson and Yellott 2012, "A unified formula for light-adapted pupil size").
inline constexpr double usual_pupil_m = 0.004;

/// Power that puts the picture of a point at `surface_m` at distance `image_m`; both axial from the lens centre, > 0.
/// Eq. 1 of the paper. An infinite `image_m` is allowed and gives 1/surface_m.
double needed_power_d(double surface_m, double image_m);

/// Where the virtual image of a point at `surface_m` lies through `power_d`, as a vergence: 1/surface_m - power_d.
/// Negative beyond infinity. Eq. 1 solved for 1/d_v.
double image_vergence_d(double surface_m, double power_d);

/// The vergence (1/m, at the lens centre) at which `depth` wants the picture of what stands `placed_m` before the lens
/// centre (axial, > 0). A depth of mode `slice` names a power and no vergence; it gets that of where it is placed.
double wanted_vergence_d(const Depth& depth, double placed_m);

/// Stands for the vergence (1/m) of what focuses between lens and pupil.
inline constexpr double most_vergence_d = 1e6;

/// A vergence at the lens centre as it is at the pupil, `lens_to_pupil_m` behind it: V / (1 + V d_e). In front of the
/// eye's own optics only this one counts: the ray through the pupil at height h meets the retina of an eye focused at f
/// where the look u - h (a - f) does, so that a point at a becomes a disc of radius p |a - f| / 2 in the tangent plane,
/// exactly, whatever its direction. A picture that would lie between lens and pupil gets the most negative.
double vergence_at_pupil_d(double at_lens_d, double lens_to_pupil_m);

/// The other way: V / (1 - V d_e). What lies between lens and pupil gets the greatest.
double vergence_at_lens_d(double at_pupil_d, double lens_to_pupil_m);

}  // namespace focalstage
