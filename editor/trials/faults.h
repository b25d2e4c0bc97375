#pragma once

#include <string>

#include "core/base/result.h"

namespace focalstage {

/// Ctrl-C. What was answered is kept.
inline Fault stopped() { return {"trials.stopped", "trials", "was stopped", "go on with --resume"}; }

inline Fault input_ended() {
  return {"trials.input-ended", "standard input", "ended before the last trial",
          "go on with --resume; what was answered is kept"};
}

/// Whether the rig is to blame: what the runner can go on after.
inline bool is_of_rig(const Fault& fault) { return fault.code.starts_with("rig.") && fault.code != "rig.trouble"; }

}  // namespace focalstage
