#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "devices/lightcrafter/packets.h"

// A report of the board, whole or cut; what it may hold is read from it as if it were each answer in turn.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace focalstage::lightcrafter;
  Report report{};
  std::copy_n(data, std::min(size, report.size()), report.begin());
  const auto answer = parse_answer(report);
  if (!answer) return 0;
  if (answer->data.size() > report.size() - 4) std::abort();
  (void)application_version(answer->data);
  (void)video_signal(answer->data);
  for (const std::uint8_t byte : answer->data) {
    (void)trouble_in(hardware_status(byte));
    if (validation(byte).ok() && validation(byte).busy) std::abort();
    (void)main_status(byte);
  }
  return 0;
}
