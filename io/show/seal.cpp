#include "io/show/seal.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include "io/files/digest.h"

namespace focalstage {
namespace {

constexpr std::string_view magic = "focalstage-show ";
constexpr std::string_view version = "2\n";
constexpr std::string_view length_word = "bytes ";
constexpr std::size_t length_at = magic.size() + version.size() + length_word.size();
constexpr std::size_t length_digits = 20;
constexpr std::string_view hash_word = "\nsha256 ";
constexpr std::size_t hash_at = length_at + length_digits + hash_word.size();
constexpr std::size_t hash_digits = 64;

std::vector<std::byte> seal_of(std::uint64_t length, const std::string& table_sha256) {
  std::string digits = std::to_string(length);
  digits.insert(0, length_digits - digits.size(), '0');
  std::string text = std::string(magic) + std::string(version) + std::string(length_word) + digits +
                     std::string(hash_word) + table_sha256 +
                     "\nof the table at the end: the SHA-256 of each MiB; HDF5 begins at byte 512\n";
  text.resize(seal_bytes, '\0');
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

std::string text_at(std::span<const std::byte> bytes, std::size_t at, std::size_t count) {
  std::string text(count, ' ');
  std::memcpy(text.data(), bytes.data() + at, count);
  return text;
}

using Table = std::vector<Sha256Value>;

/// Chunks of what lies before the table.
std::uint64_t chunks_before(std::uint64_t table_at) { return (table_at + sealed_chunk_bytes - 1) / sealed_chunk_bytes; }

/// The same from the length of the whole file, each chunk with its entry in the table.
std::uint64_t chunks_of(std::uint64_t length) {
  constexpr std::uint64_t with_entry = sealed_chunk_bytes + sizeof(Sha256Value);
  return (length + with_entry - 1) / with_entry;
}

/// The bytes from..to of a file; the first chunk begins behind the seal.
struct ByteRange {
  std::uint64_t from;
  std::uint64_t to;
};
ByteRange bytes_of(std::uint64_t chunk, std::uint64_t table_at) {
  return {chunk == 0 ? seal_bytes : chunk * sealed_chunk_bytes, std::min((chunk + 1) * sealed_chunk_bytes, table_at)};
}

/// The hash of every chunk, or nothing where one cannot be read. On one thread: a rig plays on while it takes a show.
std::optional<Table> hashes_of(const DiskFile& file, std::uint64_t table_at) {
  Table table(chunks_before(table_at));
  std::vector<std::byte> buffer(sealed_chunk_bytes);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const ByteRange range = bytes_of(i, table_at);
    const std::span chunk(buffer.data(), static_cast<std::size_t>(range.to - range.from));
    if (!file.read_at(range.from, chunk)) return {};
    table[i] = sha256_of(chunk);
  }
  return table;
}

Fault damaged(const std::string& where, const std::string& message) {
  return {"show.damaged", where, message, "copy it again, or compile the show again"};
}

/// Holds the chunks of a file of the right length against its table, and that against the seal.
Status check_chunks(const DiskFile& file, std::uint64_t table_at, const std::string& table_sha256,
                    const std::string& where) {
  Table table(chunks_before(table_at));
  const auto table_bytes = std::as_writable_bytes(std::span(table));
  if (!file.read_at(table_at, table_bytes) || hex(sha256_of(table_bytes)) != table_sha256) {
    return damaged(where, "its last " + std::to_string(table_bytes.size()) +
                              " bytes, the hashes of its chunks, are not those that its seal names");
  }
  const std::optional<Table> found = hashes_of(file, table_at);
  if (!found) return damaged(where, "it cannot be read (" + std::generic_category().message(errno) + ")");
  const auto wrong = std::mismatch(table.begin(), table.end(), found->begin()).first - table.begin();
  const auto chunk = static_cast<std::uint64_t>(wrong);
  if (chunk == table.size()) return {};
  const ByteRange range = bytes_of(chunk, table_at);
  return damaged(where, "chunk " + std::to_string(chunk) + " of " + std::to_string(table.size()) + " (bytes " +
                            std::to_string(range.from) + " to " + std::to_string(range.to) + ") was changed");
}

/// 0 where it is no number.
std::uint64_t number_in(const std::string& digits) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return error == std::errc() && end == digits.data() + digits.size() ? value : 0;
}

bool starts_with(std::span<const std::byte> bytes, std::string_view text) {
  return bytes.size() >= text.size() && std::memcmp(bytes.data(), text.data(), text.size()) == 0;
}

}  // namespace

bool write_seal(const DiskFile& file) {
  const std::uint64_t table_at = file.size();
  const std::optional<Table> table = hashes_of(file, table_at);
  if (!table) return false;
  const auto bytes = std::as_bytes(std::span(*table));
  return file.write_at(table_at, bytes) && file.write_at(0, seal_of(table_at + bytes.size(), hex(sha256_of(bytes))));
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
  if (head < seal_bytes) return damaged(where, "it is cut short: it ends in its seal, its first 512 bytes");
  const std::string claimed_length = text_at(seal, length_at, length_digits);
  const std::string table_sha256 = text_at(seal, hash_at, hash_digits);
  if (seal != seal_of(length, table_sha256)) {
    const std::uint64_t sealed = number_in(claimed_length);
    if (sealed != length && seal == seal_of(sealed, table_sha256)) {
      return damaged(where, "it has " + std::to_string(length) + " bytes, its seal says " + std::to_string(sealed));
    }
    return damaged(where, "its seal, the first 512 bytes, was changed");
  }
  const std::uint64_t table_bytes = chunks_of(length) * sizeof(Sha256Value);
  if (length < seal_bytes + table_bytes) return damaged(where, "its seal names a length that no show has");
  if (Status whole = check_chunks(file, length - table_bytes, table_sha256, where); !whole) return whole.fault();
  return table_sha256;
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
