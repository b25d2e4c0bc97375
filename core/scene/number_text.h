#pragma once

#include <string>

namespace focalstage {

/// The shortest text that reads back to the same double; "0.1", "1e+20". Not for infinities and NaN in JSON.
std::string number_text(double number);

}  // namespace focalstage
