#pragma once

#include <string>

#include "io/show/show.h"

namespace focalstage {

/// One row per exposure of a period, in time order, under a line that names each column with its unit.
std::string schedule_csv(const ShowHeader& header);

/// One row per sample of a period: time, and both eyes' lens power and drive.
std::string waveform_csv(const ShowHeader& header);

}  // namespace focalstage
