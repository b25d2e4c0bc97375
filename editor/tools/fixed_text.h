#pragma once

#include <string>

namespace focalstage {

/// A number with so many decimals, "0.120"; never "-0.000".
std::string fixed_text(double number, int decimals);

/// The same with its sign always there, "+0.120".
std::string signed_text(double number, int decimals);

}  // namespace focalstage
