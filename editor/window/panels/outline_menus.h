#pragma once

#include "editor/session/thing.h"

#include <glm/vec2.hpp>

namespace focalstage {

class Session;

/// The button that opens the menu of what can be added, `width` pixels wide.
void add_button(Session& session);

/// What can be done with what is selected, at the place where it opened.
void outline_menu(Session& session, bool open);

}  // namespace focalstage
