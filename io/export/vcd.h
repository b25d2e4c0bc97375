#pragma once

#include <string>

#include "io/show/show.h"

namespace focalstage {

/// Two periods of the show in its steady state as a Value Change Dump (IEEE 1364, four-state), in steps of 100 ns and
/// without a date: `exposing` and `image` (unknown while nothing is shown), one wire per image, `trigger` (a pulse of
/// 10 us), both shutters (1: told to open), and both lenses' power and drive as reals.
std::string timing_vcd(const ShowHeader& header);

}  // namespace focalstage
