#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "core/base/result.h"
#include "core/base/rigid.h"
#include "core/scene/project.h"

namespace focalstage {

/// World from body by the body's name; none where it is not seen now. A body that is not in it is one that the tracker
/// does not know.
using BodyPoses = std::map<std::string, std::optional<Rigid>>;

/// How things are fixed to bodies, by the body's name; the identity where nothing is said.
using BodyMounts = std::map<std::string, Rigid>;  ///< body_from_thing

/// The bodies that the viewer and all visible things of the project stand at.
std::set<std::string> bodies_of(const Project& project);

/// The project with each tracked thing where its body is: a pose of its own and no keys, at
/// world_from_body * body_from_thing. "track.unknown" and "track.unseen", with the place.
Result<Project> placed(const Project& project, const BodyPoses& world_from_body,
                       const BodyMounts& body_from_thing = {});

}  // namespace focalstage
