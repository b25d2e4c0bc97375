#include "devices/display_kms/edid.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace focalstage {

namespace {

constexpr std::array<std::uint8_t, 8> head{0x00, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x00};
constexpr std::size_t block = 128;

std::string text_of(std::span<const std::uint8_t> descriptor) {
  std::string text;
  for (const std::uint8_t letter : descriptor.subspan(5, 13)) {
    if (letter == 0x0A || letter == 0) break;
    text += letter >= 32 && letter < 127 ? static_cast<char>(letter) : '?';
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace

std::optional<EdidIdentity> parse_edid(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < block || !std::equal(head.begin(), head.end(), bytes.begin())) return std::nullopt;
  bytes = bytes.first(block);
  if (std::accumulate(bytes.begin(), bytes.end(), 0) % 256 != 0) return std::nullopt;
  EdidIdentity identity;
  const int letters = bytes[8] << 8 | bytes[9];
  for (const int shift : {10, 5, 0}) identity.maker += static_cast<char>('@' + (letters >> shift & 31));
  identity.product = bytes[10] | bytes[11] << 8;
  const auto number = bytes[12] | bytes[13] << 8 | bytes[14] << 16 | static_cast<std::uint32_t>(bytes[15]) << 24;
  if (number != 0) identity.serial = std::to_string(number);
  for (std::size_t at = 54; at + 18 <= 126; at += 18) {
    const auto descriptor = bytes.subspan(at, 18);
    if (descriptor[0] != 0 || descriptor[1] != 0) continue;  // a timing
    if (descriptor[3] == 0xFC) identity.name = text_of(descriptor);
    if (descriptor[3] == 0xFF) identity.serial = text_of(descriptor);
  }
  return identity;
}

std::string describe(const EdidIdentity& identity) {
  return identity.maker + " " + std::to_string(identity.product) + " '" + identity.name + "'" +
         (identity.serial.empty() ? "" : " " + identity.serial);
}

}  // namespace focalstage
