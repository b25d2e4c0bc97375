#pragma once

#include <string>

namespace focalstage {

/// A number with so many decimals, "0.120"; never "-0.000". What is not finite reads "∞", "-∞", "?".
std::string fixed_text(double number, int decimals);

/// The same with its sign, "+0.120"; what rounds to zero has none.
std::string signed_text(double number, int decimals);

/// A number with so many significant digits at most, as short as it can be: "0.5", "1200", "1.2e-07"; never "-0".
std::string short_text(double number, int digits = 6);

}  // namespace focalstage
