#pragma once

#include <vector>

#include "core/base/rigid.h"
#include "core/scene/process.h"
#include "core/scene/project.h"
#include "core/stage/stage.h"

// Steps that give a thing texture coordinates, made of how the room stands.
namespace focalstage {

/// One picture over all of a thing, on the plane that it faces by its areas, upright in the room; a thing that faces
/// no side more than others (a body) has it towards `seen_from_m`. The picture ends where the thing ends.
UvPlaneStep facing_plane(const std::vector<Drawable>& drawables, const Rigid& world_from_thing,
                         const glm::dvec3& seen_from_m);

/// What a projector throws on a thing, where both stand.
UvProjectorStep thrown_by(const Projector& projector, const Rigid& world_from_thing);

}  // namespace focalstage
