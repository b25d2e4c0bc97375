#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>

#include "io/files/descriptor.h"
#include "io/files/files.h"

namespace focalstage {
namespace {

Fault unreadable(const std::filesystem::path& path, int error) {
  if (error == ENOENT || error == ENOTDIR) {
    return {"file.missing", path.string(), "there is no such file", "check the path"};
  }
  return {"file.unreadable", path.string(), std::string("cannot be read: ") + std::strerror(error),
          "check the file and its permissions"};
}

Fault too_large(const std::filesystem::path& path, std::uint64_t size, std::uint64_t limit) {
  return {"file.too-large", path.string(),
          "is over " + std::to_string(limit) + " bytes long" +
              (size > limit ? " (" + std::to_string(size) + ")" : std::string()),
          "check that this is the right file"};
}

/// Reads until `buffer` is full or the file ends; the count read, or -1.
ssize_t read_into(int file, std::span<std::byte> buffer) {
  std::size_t filled = 0;
  while (filled < buffer.size()) {
    const ssize_t count = ::read(file, buffer.data() + filled, buffer.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return -1;
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  return static_cast<ssize_t>(filled);
}

}  // namespace

Result<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::uint64_t limit) {
  // Not blocking: a named pipe is refused below instead of waited for.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file.open()) return unreadable(path, errno);
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) return unreadable(path, errno);
  if (!S_ISREG(status.st_mode)) {
    return Fault{"file.unreadable", path.string(), "is no ordinary file", "name a file, not a folder or device"};
  }
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > limit) return too_large(path, size, limit);
  // One byte more than its size tells whether the file grows meanwhile.
  std::vector<std::byte> bytes;
  for (std::size_t wanted = static_cast<std::size_t>(size) + 1;; wanted *= 2) {
    const std::size_t had = bytes.size();
    bytes.resize(wanted);
    const ssize_t count = read_into(file.number(), std::span(bytes).subspan(had));
    if (count < 0) return unreadable(path, errno);
    bytes.resize(had + static_cast<std::size_t>(count));
    if (bytes.size() > limit) return too_large(path, 0, limit);
    if (bytes.size() < wanted) return bytes;
  }
}

}  // namespace focalstage
