#pragma once

#include <vector>

namespace focalstage {

/// What a projector's code, whole or between two, gives of the way from black to white: (code / highest)^gamma; or by
/// the measured `transfer`, whose values stand at evenly spaced codes from 0 to the highest, straight between them.
/// Codes beyond either end give 0 and 1.
double share_of_code(double code, int bits, double gamma, const std::vector<double>& transfer);

}  // namespace focalstage
