#pragma once

#include <optional>

#include "editor/tools/room_view.h"

namespace focalstage {

/// How far along `line` (either way) its point nearest to `ray` lies. None where the two are parallel or the ray comes
/// nearest behind its own origin: beyond the line's horizon.
std::optional<double> nearest_on_line_m(const Ray& line, const Ray& ray);

}  // namespace focalstage
