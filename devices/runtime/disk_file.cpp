#include "devices/runtime/disk_file.h"

#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace focalstage {

Fault disk_fault(const std::filesystem::path& path, int system_error) {
  if (system_error == ENOSPC || system_error == EDQUOT || system_error == EFBIG) {
    return {"rig.disk-full", path.string(), "the rig's disk is full",
            "free space on the rig, or give it another --store"};
  }
  return {"file.unwritable", path.string(), std::generic_category().message(system_error),
          "see that the rig may write to its --store"};
}

Result<DiskSlot> DiskSlot::open(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0) return disk_fault(path, errno);
  return DiskSlot(file, path);
}

DiskSlot::DiskSlot(DiskSlot&& other) noexcept : file_(std::exchange(other.file_, -1)), path_(std::move(other.path_)) {}

DiskSlot& DiskSlot::operator=(DiskSlot&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(path_, other.path_);
  return *this;
}

DiskSlot::~DiskSlot() {
  if (file_ >= 0) ::close(file_);
}

std::uint64_t DiskSlot::size_bytes() const {
  struct stat about {};
  return ::fstat(file_, &about) == 0 ? static_cast<std::uint64_t>(about.st_size) : 0;
}

std::string DiskSlot::read(std::uint64_t offset, std::size_t length) const {
  std::string data(length, '\0');
  std::size_t done = 0;
  while (done < length) {
    const ssize_t got = ::pread(file_, data.data() + done, length - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    done += static_cast<std::size_t>(got);
  }
  data.resize(done);
  return data;
}

Status DiskSlot::write(std::uint64_t offset, std::string_view data) {
  std::size_t done = 0;
  while (done < data.size()) {
    const ssize_t put = ::pwrite(file_, data.data() + done, data.size() - done, static_cast<off_t>(offset + done));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return disk_fault(path_, errno);
    done += static_cast<std::size_t>(put);
  }
  return {};
}

Status DiskSlot::truncate(std::uint64_t size_bytes) {
  if (::ftruncate(file_, static_cast<off_t>(size_bytes)) != 0) return disk_fault(path_, errno);
  return {};
}

Status DiskSlot::sync() {
  if (::fsync(file_) != 0) return disk_fault(path_, errno);
  return {};
}

}  // namespace focalstage
