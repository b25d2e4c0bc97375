#pragma once

#include <string_view>

#include "core/scene/project.h"

namespace focalstage {

/// What files and edits call a lattice of pixels.
constexpr std::string_view word_of(PixelLayout layout) { return layout == PixelLayout::diamond ? "diamond" : "square"; }

}  // namespace focalstage
