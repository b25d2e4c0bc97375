#include "editor/cli/command_list.h"

#include <array>

namespace focalstage {

std::span<const Command> commands() {
  static constexpr std::array table{
      Command{"new", "make a project folder to start from", declare_new},
      Command{"check", "find what is wrong with a project or a show", declare_check},
      Command{"compile", "compile a project into a show", declare_compile},
      Command{"export", "write a show as PNG, CSV and VCD for other tools", declare_export},
      Command{"retina", "show what an eye sees of a show", declare_retina},
      Command{"push", "send a show to a rig", declare_push},
      Command{"rig", "ask a rig for its state, or play, hold, black out", declare_rig},
      Command{"devices", "list what is plugged in where a rig is, or make one show itself", declare_devices},
      Command{"pair", "make or import the certificates by which a rig is reached", declare_pair},
      Command{"import", "say what a mesh or glTF file holds", declare_import},
      Command{"process", "say what the steps of meshes did to them, in millimetres", declare_process},
      Command{"apply", "apply a file of edits to a project", declare_apply},
      Command{"solve", "find the sweep and the slices that a project needs", declare_solve},
      Command{"adopt-rig", "set a project to what a rig measured of itself", declare_adopt_rig},
      Command{"shape", "let the lenses dwell at the slices", declare_shape},
      Command{"track-align", "say where a tracker stands, from pairs of points", declare_track_align},
      Command{"calibrate", "measure a projector, from points or camera pictures", declare_calibrate},
      Command{"trials", "run a depth-matching study and report on it", declare_trials},
      Command{"runtime", "start the rig daemon (focalstage-runtime)", declare_runtime},
      Command{"edit", "open the window (focalstage-editor)", declare_edit},
      Command{"bench", "measure the compiler's speed (focalstage-bench)", declare_bench},
  };
  return table;
}

}  // namespace focalstage
