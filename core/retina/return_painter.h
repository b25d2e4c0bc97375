#pragma once

#include "core/retina/pass_painter.h"

namespace focalstage {

/// As paint_row, in three channels, for surfaces that have colours or are lit unevenly, a projector that leaks, and the
/// room's own light: what is seen is what comes back (docs/colour.md).
void paint_returned_row(const PaintWork& work, int row, BlurLayers& layers);

/// Whether any of that is so; else paint_row says the same, faster.
bool needs_returns(const PaintWork& work);

}  // namespace focalstage
