#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "devices/mcc1208/packets.h"

// An answer of a USB-1208FS-Plus, read as each kind of answer.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace focalstage;
  const std::span answer(data, size);
  (void)read_mcc_status(answer);
  const auto codes = read_mcc_outputs(answer);
  if (codes && ((*codes)[0] > mcc_top_code || (*codes)[1] > mcc_top_code)) std::abort();
  const auto serial = read_mcc_serial(answer);
  if (serial && serial->size() != 8) std::abort();
  return 0;
}
