#pragma once

#include <stop_token>

#include "core/base/result.h"
#include "core/scene/project.h"
#include "core/stage/stage.h"
#include "editor/preview/preview_values.h"

namespace focalstage {

/// What the left eye sees of a stage, compiled at half its size: a small picture of a project, focused on what
/// is in its middle.
Result<EyePicture> paint_thumbnail(const Project& project, std::shared_ptr<const Stage> stage, int width_px,
                                   int height_px, std::stop_token stop);

}  // namespace focalstage
