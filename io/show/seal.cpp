#include "io/show/seal.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include "io/files/digest.h"

namespace focalstage {
namespace {

constexpr std::string_view magic = "focalstage-show ";
constexpr std::string_view version = "1\n";

std::vector<std::byte> seal_of(std::uint64_t length, const std::string& sha256) {
  std::string digits = std::to_string(length);
  digits.insert(0, 20 - digits.size(), '0');
  std::string text = std::string(magic) + std::string(version) + "bytes " + digits + "\nsha256 " + sha256 +
                     "\nof all that follows; HDF5 begins at byte 512\n";
  text.resize(seal_bytes, '\0');
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

/// Hex SHA-256 of the file behind its seal, or nothing where it cannot be read.
std::optional<std::string> hash_behind_seal(const DiskFile& file, std::uint64_t length) {
  Sha256 sum;
  std::vector<std::byte> buffer(1u << 20);
  for (std::uint64_t at = seal_bytes; at < length;) {
    const std::span piece(buffer.data(), static_cast<std::size_t>(std::min<std::uint64_t>(buffer.size(), length - at)));
    if (!file.read_at(at, piece)) return {};
    sum.add(piece);
    at += piece.size();
  }
  return hex(sum.value());
}

/// The hash that a seal claims; the seal is then held against what such a hash and length give.
std::string claimed_hash(std::span<const std::byte> seal) {
  constexpr std::size_t at =
      magic.size() + version.size() + std::string_view("bytes 00000000000000000000\nsha256 ").size();
  std::string text(64, ' ');
  std::memcpy(text.data(), seal.data() + at, text.size());
  return text;
}

bool starts_with(std::span<const std::byte> bytes, std::string_view text) {
  return bytes.size() >= text.size() && std::memcmp(bytes.data(), text.data(), text.size()) == 0;
}

}  // namespace

bool write_seal(const DiskFile& file) {
  const std::uint64_t length = file.size();
  const std::optional<std::string> sha256 = hash_behind_seal(file, length);
  return sha256 && file.write_at(0, seal_of(length, *sha256));
}

Result<std::string> check_seal(const DiskFile& file, const std::filesystem::path& path) {
  const std::string where = path.string();
  std::vector<std::byte> seal(seal_bytes);
  const std::uint64_t length = file.size();
  const std::size_t head = static_cast<std::size_t>(std::min<std::uint64_t>(length, seal_bytes));
  if (!file.read_at(0, std::span(seal).first(head)))
    return Fault{"show.unreadable", where, "it cannot be read (" + std::generic_category().message(errno) + ")", ""};
  if (!starts_with(std::span(seal).first(head), magic)) {
    return Fault{"show.not-a-show", where, "it is no show of Focalstage: it does not begin with \"focalstage-show\"",
                 "compile a project with \"focalstage compile\" to get one"};
  }
  if (head == seal_bytes && !starts_with(std::span(seal).subspan(magic.size()), version)) {
    return Fault{"show.version", where, "it is a show of a version this program does not know",
                 "open it with a newer Focalstage, or compile its project again"};
  }
  // Length first: a cut file need not be read whole.
  const bool whole_length = head == seal_bytes && seal == seal_of(length, claimed_hash(seal));
  const std::optional<std::string> sha256 = whole_length ? hash_behind_seal(file, length) : std::nullopt;
  if (!sha256 || seal != seal_of(length, *sha256)) {
    return Fault{"show.damaged", where,
                 "it is cut short or changed: its length or hash differs from what its seal says",
                 "copy it again, or compile the show again"};
  }
  return *sha256;
}

Result<std::string> check_seal(const std::filesystem::path& path) {
  Result<DiskFile> file = open_show(path);
  if (!file) return file.fault();
  return check_seal(*file, path);
}

Result<DiskFile> open_show(const std::filesystem::path& path) {
  // Not blocking: a pipe in a show's place must not hang whoever opens it.
  DiskFile file = open_file(path, O_RDONLY | O_NONBLOCK);
  if (!file.is_open()) {
    const bool missing = errno == ENOENT || errno == ENOTDIR;
    return Fault{
        missing ? "show.missing" : "show.unreadable", path.string(),
        missing ? "there is no such file" : "it cannot be opened (" + std::generic_category().message(errno) + ")",
        missing ? "check the name" : "check its permissions"};
  }
  struct stat status {};
  if (::fstat(file.descriptor(), &status) != 0 || !S_ISREG(status.st_mode))
    return Fault{"show.unreadable", path.string(), "it is not a file", "name a show, *.h5"};
  return file;
}

}  // namespace focalstage
