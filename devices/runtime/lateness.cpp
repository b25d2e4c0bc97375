#include "devices/runtime/lateness.h"

#include <limits>

namespace focalstage {

Lateness::Lateness() {
  for (const double up_to_us : {50.0, 100.0, 200.0, 500.0, 1e3, 2e3, 5e3, 10e3, 20e3, 50e3}) {
    bins_.push_back({up_to_us, 0});
  }
  bins_.push_back({std::numeric_limits<double>::infinity(), 0});
}

void Lateness::add(double late_s) {
  for (LatenessBin& bin : bins_) {
    if (late_s * 1e6 > bin.up_to_us) continue;
    ++bin.sweeps;
    return;
  }
}

}  // namespace focalstage
