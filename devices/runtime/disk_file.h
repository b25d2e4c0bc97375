#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace focalstage {

/// A file open for reading and writing in place; closed with the value.
class DiskSlot {
 public:
  /// Makes the file where it is missing.
  static Result<DiskSlot> open(const std::filesystem::path& path);

  DiskSlot(DiskSlot&& other) noexcept;
  DiskSlot& operator=(DiskSlot&& other) noexcept;
  ~DiskSlot();

  std::uint64_t size_bytes() const;

  /// What is there of `length` bytes from `offset` on.
  std::string read(std::uint64_t offset, std::size_t length) const;

  /// "rig.disk-full", "file.unwritable".
  Status write(std::uint64_t offset, std::string_view data);
  Status truncate(std::uint64_t size_bytes);
  Status sync();

 private:
  DiskSlot(int file, std::filesystem::path path) : file_(file), path_(std::move(path)) {}

  int file_ = -1;
  std::filesystem::path path_;
};

/// The system's last error about `path` as a Fault: "rig.disk-full" or "file.unwritable".
Fault disk_fault(const std::filesystem::path& path, int system_error);

}  // namespace focalstage
