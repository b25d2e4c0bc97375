#pragma once

#include <deque>
#include <string>

namespace focalstage {

struct LogLine {
  enum class Kind { info, good, warning, fault };

  Kind kind = Kind::info;
  std::string text;
  double at_s = 0.0;  ///< of the session's clock
};

/// What happened, newest last; the oldest of more than a thousand lines go.
using Log = std::deque<LogLine>;

}  // namespace focalstage
