#include "editor/cli/one_line.h"

namespace focalstage {
namespace {

/// How many bytes the UTF-8 sign at the start of `text` has; 0 if it is none, or one that steers a terminal.
std::size_t printable_bytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return byte(0) >= 0x20 && byte(0) != 0x7f ? 1 : 0;
  if (byte(0) < 0xc2 || byte(0) >= 0xf5) return 0;
  const std::size_t size = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (text.size() < size) return 0;
  for (std::size_t i = 1; i < size; ++i) {
    if (byte(i) < 0x80 || byte(i) >= 0xc0) return 0;
  }
  const bool overlong = (byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xf0 && byte(1) < 0x90);
  const bool outside = (byte(0) == 0xed && byte(1) >= 0xa0) || (byte(0) == 0xf4 && byte(1) >= 0x90);
  const bool control = byte(0) == 0xc2 && byte(1) < 0xa0;
  return overlong || outside || control ? 0 : size;
}

}  // namespace

std::string one_line(std::string_view text) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string line;
  while (!text.empty()) {
    const std::size_t size = printable_bytes(text);
    const auto byte = static_cast<unsigned char>(text.front());
    if (size > 0) {
      line += text.substr(0, size);
    } else if (byte == '\n' || byte == '\t') {
      line += ' ';
    } else {
      line += {'\\', 'x', digits[byte >> 4], digits[byte & 15]};
    }
    text.remove_prefix(size > 0 ? size : 1);
  }
  return line;
}

}  // namespace focalstage
