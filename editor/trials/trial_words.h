#pragma once

#include <string>
#include <vector>

#include "editor/trials/participant.h"

namespace focalstage {

// What is said names neither condition nor target: whoever reads it stays blind to both.

/// "Block 1 of 2: 21 trials, the first for training."
std::string block_text(const std::vector<TrialBlock>& plan, const TrialBlock& block);

/// "Trial 3 of 21 (block 1 of 2), pointer from 412 mm"
std::string trial_text(const TrialInPlan& at);

/// "412 mm", "412.5 mm"
std::string reading_text(double reading_m);

/// What is wrong with an answer, in a sentence.
std::string complaint(const Fault& fault);

/// Without what could steer a terminal.
std::string printable(const std::string& text);

}  // namespace focalstage
