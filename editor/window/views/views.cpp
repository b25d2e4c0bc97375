#include "editor/window/views/views.h"

#include "editor/window/views/room_pane.h"

namespace focalstage {

std::array<std::unique_ptr<Pane>, 4> make_panes() {
  std::array<std::unique_ptr<Pane>, 4> panes;
  panes[0] = std::make_unique<RoomPane>();
  return panes;
}

}  // namespace focalstage
