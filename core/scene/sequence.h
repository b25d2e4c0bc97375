#pragma once

#include <optional>
#include <string>

#include "core/scene/project.h"

namespace focalstage {

// Sequences of pictures on the project's clock.

/// Which picture of the sequence is shown at `time_s`, counted from 0; none where it shows nothing. Picture n is shown
/// from start_s + n / rate_hz on, that moment included, until the next one comes. A time that is less than a millionth
/// of a picture before such a moment counts as the moment: times that are fractions of the clock's rate fall on it
/// exactly, however long the show, though they are rounded to doubles. Of a single picture always 0.
std::optional<int> picture_at(const ImageAppearance& image, double time_s);

/// Whether the name of the file has one run of # for the number of a picture.
bool has_number_place(const std::string& file);

/// The file of picture `index`, 0 to max(count, 1) - 1: its number is filled up with zeros to as many digits as there
/// are #.
std::string picture_file(const ImageAppearance& image, int index);

}  // namespace focalstage
