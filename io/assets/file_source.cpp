#include "io/assets/file_source.h"

#include <utility>

#include "io/assets/mesh_file.h"
#include "io/files/files.h"

namespace focalstage {
namespace {

/// "assets/./a/../b" is "assets/b".
std::string plain(const std::string& path) { return std::filesystem::path(path).lexically_normal().generic_string(); }

Fault missing(const std::string& path) {
  return {"asset.missing", path, "the file " + path + " is not there", "put it beside the project"};
}

}  // namespace

Result<std::span<const std::byte>> FileSource::bytes(const std::string& path) {
  const Result<const AssetFile*> found = file(path);
  if (!found) return found.fault();
  return std::span<const std::byte>((*found)->bytes);
}

Result<const AssetFile*> FolderSource::file(const std::string& path) {
  const auto known = read_.find(path);
  if (known != read_.end()) return &known->second;
  const Result<std::filesystem::path> real = path_inside(folder_, path);
  if (!real) return real.fault();
  Result<std::vector<std::byte>> content = read_file(*real, most_file_bytes);
  if (!content && content.fault().code == "file.missing") return missing(path);
  if (!content) return content.fault();
  std::string sha256 = sha256_hex(*content);
  return &read_.emplace(path, AssetFile{path, std::move(sha256), *std::move(content)}).first->second;
}

std::vector<AssetFile> FolderSource::take() {
  std::vector<AssetFile> files;
  for (auto& [path, file] : std::exchange(read_, {})) files.push_back(std::move(file));
  return files;
}

MemorySource::MemorySource(const std::vector<AssetFile>& files) {
  for (const AssetFile& file : files) by_path_.emplace(plain(file.path), &file);
}

Result<const AssetFile*> MemorySource::file(const std::string& path) {
  const auto found = by_path_.find(plain(path));
  if (found == by_path_.end()) return missing(path);
  return found->second;
}

std::string path_beside(const std::string& path, const std::string& reference) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return (folder / reference).lexically_normal().generic_string();
}

}  // namespace focalstage
