#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "devices/optotune/packets.h"

// The first byte says how long an answer is waited for; the rest is what came.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace focalstage;
  if (size == 0) return 0;
  const std::span came = std::span(data, size).subspan(1);
  const std::size_t length = data[0] % 16;
  const OptotuneAnswer answer = read_optotune(came, length);
  if (answer.reading == OptotuneReading::good && answer.payload.size() != length) std::abort();
  (void)optotune_number(answer.payload);
  (void)optotune_number(came);
  (void)optotune_version(came);
  (void)optotune_status(came);
  return 0;
}
