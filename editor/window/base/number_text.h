#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace focalstage {

/// "0.500 m", "-1.25 D", "45.0°" (no space before a degree sign), "12" without a unit. Never "-0.000".
std::string number_text(double value, int digits, std::string_view unit);

/// What a person typed into a field of that unit: a number, a comma or point before its fraction, and perhaps a unit.
/// Metres and millimetres also take m, cm, mm; other units only their own. None where it is no finite number.
std::optional<double> typed_number(std::string_view text, std::string_view unit);

}  // namespace focalstage
