#pragma once

#include <vector>

namespace focalstage {

/// What a drive asks of a lens's coil. Its heat goes with the square of the root mean square.
struct DriveLoad {
  double peak_a = 0.0;  ///< either way
  double rms_a = 0.0;

  bool operator==(const DriveLoad&) const = default;
};

/// Of one period of uniform samples.
DriveLoad load_of(const std::vector<double>& drive_a);

}  // namespace focalstage
