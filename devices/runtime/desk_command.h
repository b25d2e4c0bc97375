#pragma once

#include <string>

namespace focalstage {

/// What a control desk says, which holds no lease.
struct DeskCommand {
  enum class Kind { play, hold, cue, next, back, go, blackout };

  Kind kind = Kind::blackout;
  std::string cue = {};  ///< its name

  bool operator==(const DeskCommand&) const = default;
};

}  // namespace focalstage
