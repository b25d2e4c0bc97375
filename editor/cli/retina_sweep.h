#pragma once

#include <string>

#include "editor/cli/command.h"
#include "editor/cli/interrupt.h"
#include "editor/cli/retina_options.h"
#include "editor/pipeline/seen_show.h"

namespace focalstage {

/// Whether a focal stack can go into `folder`: a fault where something else than a folder stands there.
Status check_sweep_folder(const std::string& folder);

/// Writes the focal stack, contrast.csv and contrast.png into the folder, and says what was seen.
ExitStatus run_sweep(const RetinaOptions& options, const SeenShow& seen, const RetinaView& view,
                     const FocusRange& range, Interrupt& interrupt);

}  // namespace focalstage
