#pragma once

#include <string>

namespace focalstage {

/// A number with so many decimals, "0.120"; never "-0.000".
std::string fixed_text(double number, int decimals);

/// The same with its sign, "+0.120"; what rounds to zero has none.
std::string signed_text(double number, int decimals);

}  // namespace focalstage
