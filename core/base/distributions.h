#pragma once

namespace focalstage {

/// The share of an F distribution above `f`: the p value of an F test. `df1`, `df2` above 0, `f` 0 or more and finite.
double f_upper_tail(double f, double df1, double df2);

/// The share of Student's t distribution farther from 0 than `t`, to both sides.
double t_two_sided(double t, double df);

/// The t below which the share `share` (between 0 and 1) of Student's distribution lies.
double t_quantile(double share, double df);

}  // namespace focalstage
