#include "editor/window/views/views.h"

#include "editor/window/views/eye_pane.h"
#include "editor/window/views/projector_pane.h"
#include "editor/window/views/room_pane.h"
#include "editor/window/views/time_pane.h"

namespace focalstage {

std::array<std::unique_ptr<Pane>, 4> make_panes() {
  return {std::make_unique<RoomPane>(), std::make_unique<ProjectorPane>(), std::make_unique<EyePane>(),
          std::make_unique<TimePane>()};
}

}  // namespace focalstage
