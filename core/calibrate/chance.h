#pragma once

namespace focalstage {

/// How improbable it is, by chance alone, that the rest agrees so much better without what brought so many equations:
/// the upper tail of Fisher's F for the fall of the square sum from `all` to `rest`, the latter with `rest_freedom`
/// degrees of freedom.
double chance_of_gain(double all, double rest, double equations, double rest_freedom);

}  // namespace focalstage
