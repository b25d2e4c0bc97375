#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace focalstage {

/// The whole file, at most `limit` bytes. Codes: "file.missing", "file.unreadable", "file.too-large".
Result<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::uint64_t limit);

/// Replaces `path` so that after any crash the old or the new file is there whole: temporary file beside it, fsync,
/// rename, fsync of the folder. Code "file.unwritable" with the system's reason (disk full, read-only).
Status write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
Status write_file_atomically(const std::filesystem::path& path, std::string_view text);

/// fsync of a folder, after a rename in it.
Status sync_folder(const std::filesystem::path& folder);

/// `relative` below `root` as a real path; a fault "path.absolute" or "path.outside" where it would leave the folder,
/// symbolic links followed.
Result<std::filesystem::path> path_inside(const std::filesystem::path& root, const std::string& relative);

/// Lower-case hex SHA-256.
std::string sha256_hex(std::span<const std::byte> bytes);
std::string sha256_hex(std::string_view text);

}  // namespace focalstage
