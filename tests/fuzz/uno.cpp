#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "devices/firmware/line.h"
#include "devices/uno/packets.h"

// The first byte chooses: even, the rest is what a port delivers, on both sides of the line; odd, it gets a good
// checksum first, so that what stands behind it is reached too.

namespace {

void as_firmware(std::string_view bytes) {
  fs_line_reader reader{};
  for (const char byte : bytes) {
    if (fs_line_push(&reader, byte) != FS_LINE_OK) continue;
    const char* at = reader.text;
    std::uint16_t number = 0;
    std::uint8_t length = 0;
    while (fs_take_word(&at, &length) != nullptr) {
    }
    at = reader.text;
    while (fs_take_number(&at, &number)) {
    }
  }
}

void as_host(std::string_view bytes) {
  using namespace focalstage::uno;
  ReplyReader reader;
  for (const char byte : bytes) {
    const auto reply = reader.push(byte);
    if (!reply) continue;
    (void)decode_status(reply->words);
    (void)decode_hello(reply->words);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  std::string bytes(data + 1, data + size);
  if (data[0] % 2 == 1) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    const unsigned crc = focalstage::uno::crc16(bytes);
    bytes += '*';
    for (const unsigned shift : {12U, 8U, 4U, 0U}) bytes += digits[crc >> shift & 15U];
    bytes += '\n';
  }
  as_firmware(bytes);
  as_host(bytes);
  return 0;
}
