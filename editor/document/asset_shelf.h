#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/mesh/model.h"
#include "core/scene/finding.h"
#include "core/scene/project.h"
#include "io/assets/assets.h"

namespace focalstage {

/// The mesh files a project refers to, each read once and again when it changed on disk. What cannot be read is a
/// finding, and the rest of the project goes on without it.
class AssetShelf {
 public:
  explicit AssetShelf(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// What was read of one reference: a model, or why there is none.
  struct Entry;
  using Read = std::map<std::string, Entry>;

  /// The references of `project` that nobody has read yet. Asks no disk: cheap enough for every step of a drag.
  std::vector<std::string> unread(const Project& project) const;
  /// Those, and the ones that changed on disk since they were read.
  std::vector<std::string> wanted(const Project& project) const;
  /// Reads them. Any thread.
  static Read read(const std::filesystem::path& folder, const std::vector<std::string>& references);
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
  static Entry read_one(const std::filesystem::path& folder, const std::string& reference);
  bool is_current(const Entry& entry) const;

  std::filesystem::path folder_;
  Read entries_;
  Assets assets_;
};

struct AssetShelf::Entry {
  std::map<std::filesystem::path, Stamp> files;  ///< that it was made of
  std::shared_ptr<const Model> model;            ///< null: `fault` says why
  Fault fault;
};

/// What `load_assets` makes of a project that refers to nothing but the mesh file `reference`.
Result<LoadedAssets> load_mesh_file(const std::string& reference, const std::filesystem::path& folder);

}  // namespace focalstage
