#pragma once

#include <vector>

#include "core/compile/frame.h"
#include "io/show/hdf5_out.h"
#include "io/show/show.h"

namespace focalstage {

/// Everything of a show but its images, in one fixed order (design section 7, docs/formats/show.md). `measures`: of the
/// frames of each projector.
void write_header(Hdf5Out& out, const ShowHeader& header,
                  const std::vector<const std::vector<FrameMeasure>*>& measures);

}  // namespace focalstage
