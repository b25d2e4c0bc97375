#pragma once

#include <string>
#include <vector>

#include "core/scene/project.h"
#include "core/stage/stage.h"
#include "editor/tools/pick.h"

namespace focalstage {

/// What stands in the room besides surfaces and objects, with a shape to see and to take hold of: the viewer's head
/// with the glasses, projectors, lamps.
struct Fixture {
  StagedName thing;  ///< lists "viewer", "projectors", "lights"
  Rigid pose;
  std::vector<Drawable> drawables;
};

std::vector<Fixture> fixtures(const Project& project, const Stage& stage);

/// The nearest of stage and fixtures.
std::optional<PickHit> first_with_fixtures(Picker& picker, const Stage& stage, const std::vector<Fixture>& fixtures,
                                           const Ray& ray, const MayPick& may = {});

/// The drawables of a thing of the room, staged or fixture; empty for anything else.
std::vector<Drawable> drawables_of(const Stage& stage, const std::vector<Fixture>& fixtures, const StagedName& thing);

}  // namespace focalstage
