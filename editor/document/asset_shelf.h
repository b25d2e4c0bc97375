#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <set>
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

  /// Reads what `project` refers to and is not here yet or changed on disk since. True if `assets` changed.
  bool fetch(const Project& project);

  /// Whether `fetch` would have something to read.
  bool is_stale(const Project& project) const;

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
  struct Entry {
    std::map<std::filesystem::path, Stamp> files;  ///< that it was made of
    std::shared_ptr<const Model> model;            ///< null: `fault` says why
    Fault fault;
  };
  static Stamp stamp_of(const std::filesystem::path& file);
  bool is_current(const Entry& entry) const;
  Entry read(const std::string& reference) const;

  std::filesystem::path folder_;
  std::map<std::string, Entry> entries_;
  Assets assets_;
};

/// The mesh files a project refers to, as it writes them.
std::set<std::string> mesh_files(const Project& project);

}  // namespace focalstage
