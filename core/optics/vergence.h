#pragma once

namespace focalstage {

/// Power that puts the picture of a point at `surface_m` at distance `image_m`; both axial from the lens centre, > 0.
/// Eq. 1 of the paper. An infinite `image_m` is allowed and gives 1/surface_m.
double needed_power_d(double surface_m, double image_m);

/// Where the virtual image of a point at `surface_m` lies through `power_d`, as a vergence: 1/surface_m - power_d.
/// Negative beyond infinity. Eq. 1 solved for 1/d_v.
double image_vergence_d(double surface_m, double power_d);

}  // namespace focalstage
