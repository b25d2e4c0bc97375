#pragma once

#include <memory>

#include "editor/window/base/panel.h"

namespace focalstage {

/// The tab of what is wrong: a click leads to the culprit, a button applies the remedy.
std::unique_ptr<Panel> make_findings_panel();

}  // namespace focalstage
