#include "io/files/digest.h"
#include "io/files/files.h"

namespace focalstage {

std::string sha256_hex(std::span<const std::byte> bytes) { return hex(sha256_of(bytes)); }
std::string sha256_hex(std::string_view text) { return hex(sha256_of(text)); }

}  // namespace focalstage
