#pragma once

#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "io/files/digest.h"

namespace focalstage {

/// A file cut into the chunks in which it travels, with the hash of each and of the whole.
class ShowChunks {
 public:
  /// Reads the file once. "file.missing", "file.unreadable", "file.too-large", "rig.cancelled".
  static Result<ShowChunks> open(const std::filesystem::path& path, const std::stop_token& stop);

  std::uint64_t size_bytes() const { return size_bytes_; }
  const std::string& sha256() const { return sha256_; }
  const std::vector<Sha256Value>& chunk_sha256() const { return chunk_sha256_; }

  /// The bytes of one chunk, as they are in the file now.
  Result<std::string> read(std::uint64_t chunk) const;

 private:
  std::filesystem::path path_;
  std::uint64_t size_bytes_ = 0;
  std::string sha256_;
  std::vector<Sha256Value> chunk_sha256_;
};

}  // namespace focalstage
