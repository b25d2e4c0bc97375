#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scene/edit.h"
#include "core/scene/project.h"
#include "editor/tools/handle_frame.h"

namespace focalstage {

/// What handles need of a thing at a moment; none for what has no place in the room (and for suns and skies, which
/// shine from everywhere).
std::optional<HandleThing> handle_thing(const Project& project, const std::string& list, const std::string& name,
                                        double time_s);

/// The edits that make `from` of the project into `to` at the moment: what did not change is left alone. Where a thing
/// has keys, the key of that moment is set, or a new one put between the others.
std::vector<Edit> pose_edits(const Project& project, const HandleThing& from, const HandleThing& to, double time_s);

/// The edits of a moving hand, for several things matched by place: always those keys that the tool can change, so that
/// every step of a drag replaces the one before it.
std::vector<Edit> drag_edits(const Project& project, HandleTool tool, const std::vector<HandleThing>& from,
                             const std::vector<HandleThing>& to, bool with_size, double time_s);

}  // namespace focalstage
