#pragma once

namespace focalstage {

/// The program `focalstage-editor`: 0 done, 1 a script failed, 2 usage, 4 no display.
int run_editor(int argc, char** argv);

}  // namespace focalstage
