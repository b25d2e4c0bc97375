#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "io/show/disk.h"

namespace focalstage {

/// The first bytes of a show, before HDF5 begins (HDF5 calls them the user block): 512 bytes of text with the file's
/// length and the SHA-256 of what follows. Whoever opens a show looks here first, so that a cut or a flipped bit is
/// found before a byte reaches the HDF5 library.
inline constexpr std::size_t seal_bytes = 512;

/// Hashes the file behind its first 512 bytes and writes them; does not sync. False with errno.
bool write_seal(const DiskFile& file);

/// The hash (lower-case hex) if length and hash are right. Faults name `path`: "show.not-a-show", "show.version",
/// "show.damaged", "show.unreadable".
Result<std::string> check_seal(const DiskFile& file, const std::filesystem::path& path);

/// The same for a file by name: "show.missing" where there is none.
Result<std::string> check_seal(const std::filesystem::path& path);

/// Opens a show for reading; "show.missing", "show.unreadable".
Result<DiskFile> open_show(const std::filesystem::path& path);

}  // namespace focalstage
