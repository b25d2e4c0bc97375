#pragma once

#include <string>
#include <vector>

#include "core/scene/edit.h"
#include "core/scene/project.h"

namespace focalstage {

/// What an edit would do to `project`, as a designer says it: "Add a slice at 0.6 D", "Set light of wall to 0.2".
std::string edit_words(const Edit& edit, const Project& project);

/// The same for all edits of a step, in a sentence.
std::string edit_words(const std::vector<Edit>& edits, const Project& project);

/// The place that a finding's pointer leads to, as a designer calls it: "rabbit", "Slice at 0.5 D", "Sweep".
std::string place_words(const std::string& pointer, const Project& project);

}  // namespace focalstage
