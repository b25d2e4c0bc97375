#include "editor/document/asset_shelf.h"

#include <system_error>

namespace focalstage {
namespace {

template <class Things, class Use>
void each_mesh(const Things& things, const std::string& list, Use&& use) {
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (const auto* file = std::get_if<FileMesh>(&things[i].mesh.shape)) {
      use(AssetReference{file->file}, "/" + list + "/" + std::to_string(i) + "/mesh/file");
    }
  }
}

/// Calls `use(reference, pointer)` for every place of the project that refers to files.
template <class Use>
void each_reference(const Project& project, Use&& use) {
  each_mesh(project.surfaces, "surfaces", use);
  each_mesh(project.objects, "objects", use);
  for (std::size_t i = 0; i < project.objects.size(); ++i) {
    if (const auto* image = std::get_if<ImageAppearance>(&project.objects[i].appearance)) {
      const int first = image->count > 0 ? image->first : 0;
      use(AssetReference{image->file, true, first, image->count},
          "/objects/" + std::to_string(i) + "/appearance/image/file");
    }
  }
  for (std::size_t i = 0; i < project.surfaces.size(); ++i) {
    if (const auto* paint = std::get_if<FileAlbedo>(&project.surfaces[i].albedo))
      use(AssetReference{paint->file, true, 0, 0}, "/surfaces/" + std::to_string(i) + "/albedo/file");
  }
}

Project project_of(const AssetReference& reference) {
  Project only;
  Object& object = only.objects.emplace_back();
  object.name = "object";
  if (!reference.picture) {
    object.mesh.shape = FileMesh{reference.file};
    return only;
  }
  ImageAppearance& image = object.appearance.emplace<ImageAppearance>();
  image.file = reference.file;
  image.first = reference.first;
  image.count = reference.count;
  return only;
}

}  // namespace

std::set<AssetReference> references_in(const Project& project) {
  std::set<AssetReference> references;
  each_reference(project,
                 [&](AssetReference reference, const std::string&) { references.insert(std::move(reference)); });
  return references;
}

Result<LoadedAssets> load_reference(const AssetReference& reference, const std::filesystem::path& folder) {
  return load_assets(project_of(reference), folder);
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

AssetShelf::Entry AssetShelf::read_one(const std::filesystem::path& folder, const AssetReference& reference) {
  Entry entry;
  // A file that changes while it is read is read again.
  for (const std::string& file : asset_files(project_of(reference))) entry.files[file] = stamp_of(folder / file);
  auto loaded = load_reference(reference, folder);
  if (!loaded) {
    entry.fault = loaded.fault();
    return entry;
  }
  for (const AssetFile& file : loaded->files) entry.files.try_emplace(file.path, stamp_of(folder / file.path));
  entry.assets = std::move(loaded->assets);
  return entry;
}

std::vector<AssetReference> AssetShelf::unread(const Project& project) const {
  std::vector<AssetReference> references;
  for (const AssetReference& reference : references_in(project)) {
    if (!entries_.contains(reference)) references.push_back(reference);
  }
  return references;
}

std::vector<AssetReference> AssetShelf::wanted(const Project& project) const {
  std::vector<AssetReference> references;
  for (const AssetReference& reference : references_in(project)) {
    const auto found = entries_.find(reference);
    if (found == entries_.end() || !is_current(found->second)) references.push_back(reference);
  }
  return references;
}

AssetShelf::Read AssetShelf::read(const std::filesystem::path& folder, const std::vector<AssetReference>& references) {
  Read read;
  for (const AssetReference& reference : references) read[reference] = read_one(folder, reference);
  return read;
}

void AssetShelf::put(Read read) {
  for (auto& [reference, entry] : read) entries_[reference] = std::move(entry);
  assets_ = {};
  for (const auto& [reference, entry] : entries_) {
    assets_.models.insert(entry.assets.models.begin(), entry.assets.models.end());
    assets_.pictures.insert(entry.assets.pictures.begin(), entry.assets.pictures.end());
  }
}

bool AssetShelf::fetch(const Project& project) {
  const std::vector<AssetReference> references = wanted(project);
  put(read(folder_, references));
  return !references.empty();
}

std::vector<Finding> AssetShelf::findings(const Project& project) const {
  std::vector<Finding> findings;
  each_reference(project, [&](const AssetReference& reference, const std::string& pointer) {
    const auto found = entries_.find(reference);
    if (found == entries_.end() || !found->second.fault) return;
    const Fault& fault = *found->second.fault;
    findings.push_back({Severity::error, fault.code, pointer, reference.file + ": " + fault.message, {}, {}});
  });
  return findings;
}

}  // namespace focalstage
