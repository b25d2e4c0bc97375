#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/mesh/model.h"
#include "core/scene/finding.h"
#include "core/scene/project.h"
#include "io/files/shared_bytes.h"

namespace focalstage {

/// One file as the project wrote it, with its bytes and their SHA-256 (lower-case hex).
struct AssetFile {
  std::string path;  ///< relative to the project folder, with forward slashes
  std::string sha256;
  SharedBytes bytes;

  bool operator==(const AssetFile&) const = default;
};

struct LoadedAssets {
  Assets assets;
  std::vector<AssetFile> files;  ///< every file the project refers to, those a glTF refers to included; by path
};

/// Pictures of one project, as they lie on disk, together.
inline constexpr std::uint64_t most_picture_bytes = std::uint64_t{512} << 20;

/// The mesh and picture files a project refers to, as it writes them, each of a sequence by its own name.
std::set<std::string> asset_files(const Project& project);

/// Whether every file that the project refers to is among the assets.
bool has_all(const Assets& assets, const Project& project);

/// Reads everything the project refers to below `folder`. Of pictures only the first bytes are looked at; their pixels
/// are made when they are asked for (StoredPicture). Faults: "asset.missing", "asset.invalid", "asset.too-large",
/// "asset.sequence" (pictures of different sizes), "image.*", "path.outside".
Result<LoadedAssets> load_assets(const Project& project, const std::filesystem::path& folder);

/// The same from files already in memory (a show): nothing beside them is read.
Result<Assets> assets_from(const Project& project, const std::vector<AssetFile>& files);

/// What a mesh or glTF file holds.
struct ImportReport {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::shared_ptr<const Model> model;
  std::vector<Finding> findings;
};

/// Reads one mesh or glTF file and says what is in it. `file` by its own name, beside the files it refers to.
Result<ImportReport> inspect_asset(const std::filesystem::path& file);

}  // namespace focalstage
