#pragma once

#include <string>

#include "core/base/result.h"

namespace focalstage::uno {

/// The board's numbers in words, with what to do. `path` is its port.

/// Why it went dark by itself.
Fault darkness(const std::string& path, unsigned reason);
/// Why it restarted: MCUSR.
Fault restarted(const std::string& path, unsigned cause);
/// Why it did not do a command.
Fault refusal(const std::string& path, const std::string& command, unsigned code);
/// What TEST found: which pins.
Fault failed_test(const std::string& path, const std::string& bits);

}  // namespace focalstage::uno
