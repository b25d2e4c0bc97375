#include <fcntl.h>
#include <sys/stat.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string>

#include "io/files/descriptor.h"
#include "io/files/files.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

Fault unwritable(const fs::path& path, int error) {
  std::string remedy = "check the folder and its permissions";
  if (error == ENOSPC || error == EDQUOT) remedy = "free some space; the file is as it was before";
  if (error == EROFS) remedy = "choose a folder that can be written; this one is read-only";
  return {"file.unwritable", path.string(), std::string("cannot be written: ") + std::strerror(error),
          std::move(remedy)};
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

bool write_all(int file, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

/// The file that a symbolic link means, so that saving through a link keeps the link.
fs::path behind_links(const fs::path& path) {
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  return error ? path : real;
}

/// A new file in the target's folder. At first it has no name where the file system can do that, so that a kill leaves
/// nothing behind; it goes unless it has been renamed to the target.
class Temporary {
 public:
  enum class Start { unnamed, named };

  Temporary(const fs::path& target, Start start) : target_(target) {
    if (start == Start::named) {
      create_name([&] {
        file_ = Descriptor(::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
        return file_.open();
      });
    } else {
      file_ = Descriptor(::open(folder_of(target).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666));
    }
  }
  ~Temporary() {
    if (!name_.empty()) ::unlink(name_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  bool open() const { return file_.open(); }

  /// A replaced file keeps its permissions; a new one got those of any new file.
  bool fill(std::span<const std::byte> bytes) {
    struct stat status {};
    const bool replaces = ::stat(target_.c_str(), &status) == 0;
    if (replaces && ::fchmod(file_.number(), status.st_mode & 07777) != 0) return false;
    return write_all(file_.number(), bytes) && ::fsync(file_.number()) == 0;
  }

  /// False, with the name still missing, where an unnamed file cannot be named (no /proc).
  bool has_name() {
    if (!name_.empty()) return true;
    const std::string self = "/proc/self/fd/" + std::to_string(file_.number());
    return create_name(
        [&] { return ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name_.c_str(), AT_SYMLINK_FOLLOW) == 0; });
  }

  bool become_target() {
    if (!file_.close() || ::rename(name_.c_str(), target_.c_str()) != 0) return false;
    name_.clear();
    return true;
  }

 private:
  /// Tries names that no file of ours ends in until `create` takes one, or fails for another reason than a taken name.
  template <class Create>
  bool create_name(Create&& create) {
    static std::atomic<unsigned> counter{0};
    do {
      const std::string own = ".saving-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
      name_ = (folder_of(target_) / own).string();
      if (create()) return true;
    } while (errno == EEXIST);
    name_.clear();
    return false;
  }

  fs::path target_;
  std::string name_;  ///< empty: none
  Descriptor file_{-1};
};

}  // namespace

Status write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  const fs::path target = behind_links(path);
  std::optional<Temporary> temporary(std::in_place, target, Temporary::Start::unnamed);
  bool written = temporary->open() && temporary->fill(bytes);
  if (!temporary->open() || (written && !temporary->has_name())) {
    temporary.emplace(target, Temporary::Start::named);
    written = temporary->open() && temporary->fill(bytes);
  }
  if (!written || !temporary->become_target()) return unwritable(path, errno);
  return sync_folder(folder_of(target));
}

Status write_file_atomically(const fs::path& path, std::string_view text) {
  return write_file_atomically(path, std::as_bytes(std::span(text)));
}

Status sync_folder(const fs::path& folder) {
  const Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!opened.open()) return unwritable(folder, errno);
  // Some network file systems have no such thing and say EINVAL; there is nothing more to be done on them.
  if (::fsync(opened.number()) != 0 && errno != EINVAL) return unwritable(folder, errno);
  return {};
}

}  // namespace focalstage
