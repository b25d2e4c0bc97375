#pragma once

#include <vector>

#include "io/protocol/rig_values.h"

namespace focalstage {

/// How late sweeps were handed over, against the plan.
class Lateness {
 public:
  Lateness();

  void add(double late_s);
  const std::vector<LatenessBin>& bins() const { return bins_; }

 private:
  std::vector<LatenessBin> bins_;
};

}  // namespace focalstage
