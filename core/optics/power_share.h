#pragma once

namespace focalstage {

/// A part of an exposure, as the eye gets it through its lens at one power. The parts of one that the shutter lets
/// through whole sum to one.
struct PowerShare {
  double power_d = 0.0;
  double share = 1.0;  ///< time and the shutter's transmission, of a whole exposure

  bool operator==(const PowerShare&) const = default;
};

}  // namespace focalstage
