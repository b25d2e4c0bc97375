#pragma once

#include <string>

#include <glm/gtc/quaternion.hpp>

#include "core/stage/stage.h"
#include "tests/support/chance.h"
#include "tests/support/shapes.h"

// Single things drawn by chance. Each adds its name to `story`.
namespace focalstage::exact {

/// A turn of up to `most_deg` about any axis.
glm::dquat turned(support::Chance& chance, double most_deg);

support::SharedMesh random_surface(support::Chance& chance, double size_m, std::string& story);
support::SharedMesh random_object(support::Chance& chance, double size_m, std::string& story);
Finish random_finish(support::Chance& chance, std::string& story);

/// `slices`: how many there are to be pinned to.
Depth random_depth(support::Chance& chance, std::size_t slices, std::string& story);

Light random_light(support::Chance& chance);

}  // namespace focalstage::exact
