#include "core/schedule/drive_load.h"

#include <algorithm>
#include <cmath>

namespace focalstage {

DriveLoad load_of(const std::vector<double>& drive_a) {
  DriveLoad load;
  if (drive_a.empty()) return load;
  double square = 0.0;
  for (const double current_a : drive_a) {
    load.peak_a = std::max(load.peak_a, std::abs(current_a));
    square += current_a * current_a;
  }
  load.rms_a = std::sqrt(square / static_cast<double>(drive_a.size()));
  return load;
}

}  // namespace focalstage
