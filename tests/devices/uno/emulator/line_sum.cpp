#include "tests/devices/uno/emulator/line_sum.h"

#include <cstdio>

namespace focalstage::uno_emulator {

std::string with_sum(const std::string& body) {
  unsigned crc = 0xFFFF;
  for (const char byte : body) {
    crc ^= static_cast<unsigned>(static_cast<unsigned char>(byte)) << 8;
    for (int bit = 0; bit < 8; ++bit) crc = ((crc << 1) ^ ((crc & 0x8000U) != 0 ? 0x1021U : 0U)) & 0xFFFFU;
  }
  char sum[8];
  std::snprintf(sum, sizeof sum, "*%04X", crc);
  return body + sum;
}

std::string without_sum(const std::string& line) {
  const std::size_t star = line.rfind('*');
  if (star == std::string::npos || with_sum(line.substr(0, star)) != line) return {};
  return line.substr(0, star);
}

}  // namespace focalstage::uno_emulator
