#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "core/base/result.h"

namespace focalstage {

/// An open file; closed with the value.
class DiskFile {
 public:
  DiskFile() = default;
  explicit DiskFile(int descriptor) : descriptor_(descriptor) {}
  DiskFile(DiskFile&& other) noexcept;
  DiskFile& operator=(DiskFile&& other) noexcept;
  ~DiskFile();

  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  std::uint64_t size() const;

  /// All of `bytes` at `offset`; false (with errno) where the system refuses, or for reading, where the file is
  /// shorter.
  bool read_at(std::uint64_t offset, std::span<std::byte> bytes) const;
  bool write_at(std::uint64_t offset, std::span<const std::byte> bytes) const;

 private:
  int descriptor_ = -1;
};

DiskFile open_file(const std::filesystem::path& path, int flags);

/// What `error` (an errno) means for a show that is being written: "show.disk-full" or "show.unwritable".
Fault write_fault(const std::filesystem::path& path, int error);

/// fsync of a folder, so that a rename in it survives a power cut; false with errno.
bool sync_directory(const std::filesystem::path& folder);

/// The folder a file lies in; "." for a bare name.
std::filesystem::path folder_of(const std::filesystem::path& file);

}  // namespace focalstage
