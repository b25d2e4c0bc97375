#include "editor/window/panels/panels.h"

namespace focalstage {

std::vector<std::unique_ptr<Panel>> make_panels() { return {}; }

}  // namespace focalstage
