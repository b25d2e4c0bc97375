#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace focalstage {

/// The assets that live links sent by hash. Kept on disk, so that none travels twice, not even across restarts. Any
/// thread.
///
///     DIR/assets/SHA    whole, and named by the hash of its bytes; read back only if they still are what it says
class AssetStore {
 public:
  /// "file.unwritable", "rig.disk-full"
  static Result<std::unique_ptr<AssetStore>> open(const std::filesystem::path& folder);

  bool has(const std::string& sha256) const;

  /// "live.asset" where it is not here any more as it was.
  Result<std::vector<std::byte>> read(const std::string& sha256) const;

  /// "rig.damaged" where these are not the bytes of that name; "rig.disk-full".
  Status add(const std::string& sha256, std::string_view bytes);

 private:
  explicit AssetStore(std::filesystem::path folder) : folder_(std::move(folder)) {}
  std::filesystem::path path_of(const std::string& sha256) const { return folder_ / sha256; }

  std::filesystem::path folder_;
};

/// Fit to name a file.
bool is_sha256_hex(std::string_view text);

}  // namespace focalstage
