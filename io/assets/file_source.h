#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "io/assets/assets.h"

namespace focalstage {

/// Where the files of a project come from: each asked for by its path from the project's folder, and kept.
class FileSource {
 public:
  virtual ~FileSource() = default;

  /// Codes "asset.missing", "path.outside", "path.absolute", "file.*". Good as long as the source is.
  virtual Result<const AssetFile*> file(const std::string& path) = 0;

  Result<std::span<const std::byte>> bytes(const std::string& path);
};

/// A folder on disk; nothing above it can be reached. What was read is kept as it was then.
class FolderSource : public FileSource {
 public:
  explicit FolderSource(std::filesystem::path folder) : folder_(std::move(folder)) {}

  Result<const AssetFile*> file(const std::string& path) override;

  /// Everything read so far, by path.
  std::vector<AssetFile> take();

 private:
  std::filesystem::path folder_;
  std::map<std::string, AssetFile> read_;
};

/// Files in memory, which must outlive it.
class MemorySource : public FileSource {
 public:
  explicit MemorySource(const std::vector<AssetFile>& files);

  Result<const AssetFile*> file(const std::string& path) override;

 private:
  std::map<std::string, const AssetFile*> by_path_;
};

/// The path of a file that the one at `path` refers to as `reference`.
std::string path_beside(const std::string& path, const std::string& reference);

}  // namespace focalstage
