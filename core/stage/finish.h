#pragma once

#include "core/mesh/model.h"
#include "core/scene/project.h"
#include "core/stage/stage.h"

namespace focalstage {

/// What an object's appearance and its file's material (null: none, white) come to. Only materials take light, and only
/// where there is some: in a project without lights they show their base colour as it is.
Finish finish_of(const Appearance& appearance, const Material* material, bool has_lights);

}  // namespace focalstage
