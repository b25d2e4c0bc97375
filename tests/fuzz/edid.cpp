#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "devices/display_kms/edid.h"

// An EDID as a display tells it, and once more with the sum put right, since few inputs would pass it.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace focalstage;
  std::vector<std::uint8_t> bytes(data, data + size);
  (void)parse_edid(bytes);
  if (bytes.size() < 128) return 0;
  std::uint8_t sum = 0;
  for (std::size_t i = 0; i < 127; ++i) sum = static_cast<std::uint8_t>(sum + bytes[i]);
  bytes[127] = static_cast<std::uint8_t>(256 - sum);
  const auto identity = parse_edid(bytes);
  if (!identity) return 0;
  if (identity->maker.size() != 3 || identity->name.size() > 13 || identity->serial.size() > 13) std::abort();
  (void)describe(*identity);
  return 0;
}
