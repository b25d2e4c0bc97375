#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/mesh/model.h"
#include "core/scene/finding.h"
#include "core/scene/project.h"
#include "io/assets/assets.h"

namespace focalstage {

/// What a project refers to: a mesh file, a picture, or the pictures of a sequence.
struct AssetReference {
  std::string file;  ///< as the project writes it
  bool picture = false;
  int first = 0;
  int count = 0;  ///< of a sequence

  auto operator<=>(const AssetReference&) const = default;
};

/// The files a project refers to, each read once and again when it changed on disk. What cannot be read is a
/// finding, and the rest of the project goes on without it.
class AssetShelf {
 public:
  explicit AssetShelf(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// What was read of one reference, or why there is nothing.
  struct Entry;
  using Read = std::map<AssetReference, Entry>;

  /// The references of `project` that nobody has read yet. Asks no disk: cheap enough for every step of a drag.
  std::vector<AssetReference> unread(const Project& project) const;
  /// Those, and the ones that changed on disk since they were read.
  std::vector<AssetReference> wanted(const Project& project) const;
  /// Reads them. Any thread.
  static Read read(const std::filesystem::path& folder, const std::vector<AssetReference>& references);
  void put(Read read);

  /// All three at once. True if `assets` changed.
  bool fetch(const Project& project);

  const Assets& assets() const { return assets_; }
  /// One error "asset.missing" or "asset.invalid" per reference that cannot be had.
  std::vector<Finding> findings(const Project& project) const;

  const std::filesystem::path& folder() const { return folder_; }
  void move_to(std::filesystem::path folder) { folder_ = std::move(folder); }

 private:
  struct Stamp {
    std::filesystem::file_time_type changed{};
    std::uintmax_t bytes = 0;
    bool operator==(const Stamp&) const = default;
  };
  static Stamp stamp_of(const std::filesystem::path& file);
  static Entry read_one(const std::filesystem::path& folder, const AssetReference& reference);
  bool is_current(const Entry& entry) const;

  std::filesystem::path folder_;
  Read entries_;
  Assets assets_;
};

struct AssetShelf::Entry {
  std::map<std::filesystem::path, Stamp> files;  ///< that it was made of
  Assets assets;                                 ///< what of it is there
  std::optional<Fault> fault;                    ///< why there is nothing
};

/// Everything a project refers to, each once.
std::set<AssetReference> references_in(const Project& project);

/// What `load_assets` makes of a project that refers to nothing else.
Result<LoadedAssets> load_reference(const AssetReference& reference, const std::filesystem::path& folder);

}  // namespace focalstage
