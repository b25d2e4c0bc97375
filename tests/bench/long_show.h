#pragma once

#include <string>

#include "core/base/result.h"

namespace focalstage::bench {

/// What compiling a long show took, beside its frames alone.
struct LongShow {
  int frames = 0;
  double frame_ms = 0.0;      ///< staging and compiling one frame, alone
  double frame_cpu_ms = 0.0;  ///< the same, counted on all threads
  double show_s = 0.0;        ///< `focalstage compile`, from its start to the finished show
  double show_cpu_s = 0.0;
  double most_memory_mib = 0.0;  ///< of that process
  double show_mib = 0.0;

  double slower() const { return show_s * 1e3 / (frame_ms * frames); }
};

/// Compiles three moving rabbits for `frames` frames with the program beside this one, into a folder that is removed.
Result<LongShow> compile_long_show(int frames);

}  // namespace focalstage::bench
