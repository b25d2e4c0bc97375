#pragma once

#include <memory>

#include "editor/window/base/panel.h"

namespace focalstage {

/// What the session must know before it goes on.
std::unique_ptr<Panel> make_question_panel();

}  // namespace focalstage
