#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <vector>

#include "core/base/result.h"
#include "core/compile/frame.h"
#include "editor/pipeline/frame_maker.h"
#include "editor/pipeline/source.h"
#include "io/show/show.h"

namespace focalstage {

/// A map as 8-bit RGB, rows from the top. Red: the share of the light wanted that is missing where full white is not
/// enough. Blue: where less is wanted than leaks through black, 255 for `darkest` (as a share of full white) and
/// beyond. What is marked at all is so by 64 at least.
std::vector<std::uint8_t> clip_picture(const ClipMap& map, double darkest);

/// What an eye's exposures of a period leak together at most, as a share of full white.
double whole_leak(const CompileSettings& settings);

/// Compiles the frames once more for where their light cannot be reached; `take` gets each, and ends it by a fault.
Status each_clip_map(const Source& source, FrameRange frames, const std::function<Status(int, const ClipMap&)>& take,
                     const FrameProgress& progress, const std::stop_token& stop);

}  // namespace focalstage
