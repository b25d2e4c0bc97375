#pragma once

#include <memory>

#include <spdlog/formatter.h>

#include "io/rig_config/rig_config.h"

namespace focalstage {

/// One JSON object per line: time (UTC), level, message.
std::unique_ptr<spdlog::formatter> json_lines();

/// All that is logged goes to stderr through a thread of its own: where stderr does not take it, the oldest lines are
/// lost, and nobody who logs waits.
class Logs {
 public:
  Logs(LogLevel level, bool json);
  ~Logs();
};

}  // namespace focalstage
