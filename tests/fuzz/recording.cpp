#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "devices/recording/recording_text.h"

// What is read is written again as it was read.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace focalstage;
  std::istringstream text(std::string(reinterpret_cast<const char*>(data), size));
  const auto recording = read_recording(text, "fuzz");
  if (!recording) return 0;
  std::string again = recording_head();
  for (const TrackedFrame& frame : *recording) again += recording_lines(frame);
  std::istringstream again_text(again);
  if (!read_recording(again_text, "again")) __builtin_trap();
  return 0;
}
