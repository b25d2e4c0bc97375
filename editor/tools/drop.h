#pragma once

#include <optional>

#include "editor/tools/pick.h"

namespace focalstage {

/// How far the drawables can go along `way` (of length one) until a point of them touches something of the stage that
/// `may_stop` lets stop them (all, where it is empty). None where nothing lies in that way. Looked at from at most a
/// few thousand of their vertices.
std::optional<double> drop_m(const Stage& stage, const std::vector<Drawable>& drawables, const glm::dvec3& way,
                             Picker& picker, const MayPick& may_stop = {});

}  // namespace focalstage
