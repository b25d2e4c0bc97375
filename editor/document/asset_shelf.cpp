#include "editor/document/asset_shelf.h"

#include <system_error>

namespace focalstage {
namespace {

template <class Things, class Use>
void each_file(const Things& things, const std::string& list, Use&& use) {
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (const auto* file = std::get_if<FileMesh>(&things[i].mesh.shape)) {
      use(file->file, "/" + list + "/" + std::to_string(i) + "/mesh/file");
    }
  }
}

}  // namespace

Result<LoadedAssets> load_mesh_file(const std::string& reference, const std::filesystem::path& folder) {
  Project only;
  only.objects.emplace_back();
  only.objects[0].name = "object";
  only.objects[0].mesh.shape = FileMesh{reference};
  return load_assets(only, folder);
}

AssetShelf::Stamp AssetShelf::stamp_of(const std::filesystem::path& file) {
  std::error_code none;
  Stamp stamp;
  stamp.changed = std::filesystem::last_write_time(file, none);
  stamp.bytes = std::filesystem::file_size(file, none);
  return stamp;
}

bool AssetShelf::is_current(const Entry& entry) const {
  for (const auto& [file, stamp] : entry.files) {
    if (stamp_of(folder_ / file) != stamp) return false;
  }
  return true;
}

AssetShelf::Entry AssetShelf::read_one(const std::filesystem::path& folder, const std::string& reference) {
  Entry entry;
  entry.files[reference] = stamp_of(folder / reference);
  auto loaded = load_mesh_file(reference, folder);
  if (!loaded) {
    entry.fault = loaded.fault();
    return entry;
  }
  for (const AssetFile& file : loaded->files) entry.files[file.path] = stamp_of(folder / file.path);
  entry.model = loaded->assets.models.at(reference);
  return entry;
}

std::vector<std::string> AssetShelf::unread(const Project& project) const {
  std::vector<std::string> references;
  for (const std::string& file : mesh_files(project)) {
    if (!entries_.contains(file)) references.push_back(file);
  }
  return references;
}

std::vector<std::string> AssetShelf::wanted(const Project& project) const {
  std::vector<std::string> references;
  for (const std::string& file : mesh_files(project)) {
    const auto found = entries_.find(file);
    if (found == entries_.end() || !is_current(found->second)) references.push_back(file);
  }
  return references;
}

AssetShelf::Read AssetShelf::read(const std::filesystem::path& folder, const std::vector<std::string>& references) {
  Read read;
  for (const std::string& reference : references) read[reference] = read_one(folder, reference);
  return read;
}

void AssetShelf::put(Read read) {
  for (auto& [reference, entry] : read) {
    if (entry.model) assets_.models[reference] = entry.model;
    if (!entry.model) assets_.models.erase(reference);
    entries_[reference] = std::move(entry);
  }
}

bool AssetShelf::fetch(const Project& project) {
  const std::vector<std::string> references = wanted(project);
  put(read(folder_, references));
  return !references.empty();
}

std::vector<Finding> AssetShelf::findings(const Project& project) const {
  std::vector<Finding> findings;
  const auto add = [&](const std::string& file, const std::string& pointer) {
    const auto found = entries_.find(file);
    if (found == entries_.end() || found->second.model) return;
    const Fault& fault = found->second.fault;
    findings.push_back({Severity::error, fault.code, pointer, file + ": " + fault.message, {}, {}});
  };
  each_file(project.surfaces, "surfaces", add);
  each_file(project.objects, "objects", add);
  return findings;
}

}  // namespace focalstage
