#pragma once

#include <memory>

#include "core/base/result.h"
#include "core/mesh/model.h"
#include "core/scene/project.h"
#include "core/stage/stage.h"

namespace focalstage {

/// What an object's appearance and its file's material (null: none, white) come to. Only materials take light, and only
/// where there is some: in a project without lights they show their base colour as it is.
/// `picture`: of an image.
Finish finish_of(const Appearance& appearance, const Material* material, bool has_lights,
                 const std::shared_ptr<const Texture>& picture = nullptr);

/// The picture that an appearance shows at `time_s`, or null where it is none or its sequence shows none then. Codes
/// "stage.asset-missing", "image.*"; the place is relative to the appearance.
Result<std::shared_ptr<const Texture>> picture_of(const Appearance& appearance, const Assets& assets, double time_s);

/// Whether at `time_s` there is nothing to be drawn of a thing that looks so: its sequence has ended, or not begun.
bool shows_nothing(const Appearance& appearance, double time_s);

/// What a surface's albedo and its file's material come to: what share of the light on it comes back, whatever light
/// that is. `picture`: of a file's albedo.
Finish finish_of(const Albedo& albedo, const Material* material, std::shared_ptr<const Texture> picture);

}  // namespace focalstage
