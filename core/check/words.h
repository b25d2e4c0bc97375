#pragma once

#include <cstddef>
#include <string>

#include "core/scene/project.h"

namespace focalstage {

/// A number as a person reads it: four significant digits, no trailing zeros.
std::string words(double number);

/// A share as a percentage.
std::string percent(double share);

/// JSON pointers into the project.
std::string slice_pointer(std::size_t slice);
std::string item_pointer(const std::string& list, std::size_t index);

/// The waveform of one eye: one pointer where both eyes share it.
std::string waveform_pointer(const Sweep& sweep, Side eye);

}  // namespace focalstage
