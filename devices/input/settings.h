#pragma once

#include <array>
#include <string>

namespace focalstage {

/// Which of a device's own axes (0 to 5: x, y, z and the turns about them) an axis of ours is, and its sign.
struct SpaceMouseAxis {
  int own = 0;
  double sign = 1.0;
};

struct SpaceMouseSettings {
  std::string serial;          ///< of the one that is meant; empty: the first that is found
  double full_counts = 350.0;  ///< of full deflection
  double dead_counts = 8.0;    ///< up to here it counts as untouched
  double silence_s = 0.100;    ///< after so long without a report nobody touches it: the last report may have been lost
  /// Ours (push x, y, z, turn x, y, z; +Y up, +Z towards the user) from its own axes: x right, y towards the user, z
  /// down, turns by the right hand.
  std::array<SpaceMouseAxis, 6> axes{{{0, 1.0}, {2, -1.0}, {1, 1.0}, {3, 1.0}, {5, -1.0}, {4, 1.0}}};
};

}  // namespace focalstage
