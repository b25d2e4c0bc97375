#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "devices/camera/pgm.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream bytes(std::string(reinterpret_cast<const char*>(data), size));
  const auto image = focalstage::read_pgm(bytes, "fuzz");
  if (image && image->gray.size() > size) __builtin_trap();
  return 0;
}
