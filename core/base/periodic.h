#pragma once

#include <span>

namespace focalstage {

/// Uniform samples of one period, straight between them and from the last to the first, after `turns` periods (any
/// number, negative too). In the samples' own unit; 0 where there are none.
double periodic_at(std::span<const double> samples, double turns);

/// `time_s` within [0, `period_s`), `period_s` > 0.
double wrapped_s(double time_s, double period_s);

}  // namespace focalstage
