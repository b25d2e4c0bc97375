#pragma once

#include <string>

namespace focalstage::uno_emulator {

/// A line with its checksum, as devices/firmware/README.md has it; without its end.
std::string with_sum(const std::string& body);
/// The line without its checksum; empty if that is wrong.
std::string without_sum(const std::string& line);

}  // namespace focalstage::uno_emulator
