#include "editor/window/views/views.h"

namespace focalstage {

std::array<std::unique_ptr<Pane>, 4> make_panes() { return {}; }

}  // namespace focalstage
