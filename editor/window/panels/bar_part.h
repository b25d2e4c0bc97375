#pragma once

#include <memory>

#include "editor/window/panels/bar_fit.h"

namespace focalstage {

class Session;

/// One thing in the bar. Each frame: `look`, then `draw` in the form that fits, with the cursor where it stands.
class BarPart {
 public:
  virtual ~BarPart() = default;

  /// Takes what it shows from the session; its forms' widths.
  virtual BarItem look(const Session& session) = 0;
  virtual void draw(Session& session, std::size_t form) = 0;
};

using BarPartPtr = std::unique_ptr<BarPart>;

// From the left.
BarPartPtr make_file_part();
BarPartPtr make_undo_part();
BarPartPtr make_project_part();
BarPartPtr make_compile_part();
BarPartPtr make_findings_part();
BarPartPtr make_tasks_part();

// At the right.
BarPartPtr make_rig_part();
BarPartPtr make_play_part();
BarPartPtr make_push_part();
BarPartPtr make_live_part();
BarPartPtr make_blackout_part();

}  // namespace focalstage
