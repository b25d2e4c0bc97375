#pragma once

#include <vector>

#include "core/compile/frame.h"
#include "io/show/hdf5_in.h"
#include "io/show/show.h"

namespace focalstage {

/// The header of the show that `in` holds, and leaves its images opened for chunks. Check `in.ok()` after it; ranges
/// are for `check_header`.
ShowHeader read_header(Hdf5In& in);

/// What was measured of the frames of `header` as one projector makes them.
std::vector<FrameMeasure> read_measures(Hdf5In& in, const ShowHeader& header, std::size_t projector);

}  // namespace focalstage
