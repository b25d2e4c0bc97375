#pragma once

#include <memory>

#include "devices/roles/motion_input.h"
#include "devices/sample/settings.h"

namespace focalstage {

/// A motion input whose device is a text file: its last line is how far the hand pushes now. The driver to begin with,
/// and a hand for tests. Faults: "input.absent" (no such file), "input.damaged" (its last line says nothing),
/// "input.lost".
std::unique_ptr<MotionInput> make_sample_input(const SampleSettings& settings);

}  // namespace focalstage
