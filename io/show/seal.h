#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "io/show/disk.h"

namespace focalstage {

/// A show lies between a seal before HDF5 begins (HDF5 calls such bytes the user block) and a table behind its end:
///
///     512 bytes of text: the file's length, and the SHA-256 of the table
///     HDF5
///     the table: the SHA-256 of each MiB of the file up to here, the first without the 512 bytes
///
/// Whoever opens a show looks here first, so that a cut or a flipped bit is found, and the MiB it lies in named, before
/// a byte reaches the HDF5 library.
inline constexpr std::size_t seal_bytes = 512;
inline constexpr std::uint64_t sealed_chunk_bytes = 1u << 20;  ///< those in which a show is pushed

/// Hashes the file behind its first 512 bytes, appends the table and writes the seal; does not sync. False with errno.
bool write_seal(const DiskFile& file);

/// The seal's hash (lower-case hex) if length, table and every chunk are right. Faults name `path`:
/// "show.not-a-show", "show.version", "show.unreadable", and "show.damaged" with the chunk and its bytes.
Result<std::string> check_seal(const DiskFile& file, const std::filesystem::path& path);

/// The same for a file by name: "show.missing" where there is none.
Result<std::string> check_seal(const std::filesystem::path& path);

/// Opens a show for reading; "show.missing", "show.unreadable".
Result<DiskFile> open_show(const std::filesystem::path& path);

}  // namespace focalstage
