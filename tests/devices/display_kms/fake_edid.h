#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace focalstage {

/// An EDID of 128 bytes as VESA's standard lays it out.
inline std::vector<std::uint8_t> edid_of(const std::string& maker, int product, std::uint32_t number,
                                         const std::string& name, const std::string& serial) {
  std::vector<std::uint8_t> bytes(128, 0);
  for (std::size_t i = 1; i < 7; ++i) bytes[i] = 0xFF;
  const int letters = (maker[0] - '@') << 10 | (maker[1] - '@') << 5 | (maker[2] - '@');
  bytes[8] = static_cast<std::uint8_t>(letters >> 8);
  bytes[9] = static_cast<std::uint8_t>(letters & 0xFF);
  bytes[10] = static_cast<std::uint8_t>(product & 0xFF);
  bytes[11] = static_cast<std::uint8_t>(product >> 8);
  for (std::size_t i = 0; i < 4; ++i) bytes[12 + i] = static_cast<std::uint8_t>(number >> (8 * i) & 0xFFU);
  bytes[18] = 1;
  bytes[19] = 4;
  bytes[54] = 0x10;  // a timing, which is no text
  const auto put = [&](std::size_t at, std::uint8_t kind, const std::string& text) {
    bytes[at + 3] = kind;
    for (std::size_t i = 0; i < 13; ++i) {
      bytes[at + 5 + i] = i < text.size() ? static_cast<std::uint8_t>(text[i]) : i == text.size() ? 0x0A : 0x20;
    }
  };
  if (!name.empty()) put(72, 0xFC, name);
  if (!serial.empty()) put(90, 0xFF, serial);
  int sum = 0;
  for (const std::uint8_t byte : bytes) sum += byte;
  bytes[127] = static_cast<std::uint8_t>(256 - sum % 256);
  return bytes;
}

}  // namespace focalstage
