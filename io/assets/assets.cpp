#include "io/assets/assets.h"

#include <utility>

#include "io/assets/file_source.h"
#include "io/assets/mesh_file.h"

namespace focalstage {
namespace {

/// The place of a mesh file in the project.
struct Reference {
  std::string path;
  std::string pointer;
};

template <class Things>
void add_references(const Things& things, const std::string& list, std::vector<Reference>& references) {
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (const auto* file = std::get_if<FileMesh>(&things[i].mesh.shape)) {
      references.push_back({file->file, "/" + list + "/" + std::to_string(i) + "/mesh/file"});
    }
  }
}

Result<MeshFile> read_from(FileSource& source, const std::string& path) {
  const Result<std::span<const std::byte>> bytes = source.bytes(path);
  if (!bytes) return bytes.fault();
  const auto companion = [&](const std::string& reference) { return source.bytes(path_beside(path, reference)); };
  return read_mesh_file({path, *bytes, companion});
}

/// A file that cannot be had is a matter of the project, which says so at its reference; what is wrong inside a file
/// keeps its place there.
Fault placed_in_project(Fault fault, const Reference& reference) {
  const bool cannot_be_had =
      fault.code == "asset.missing" || fault.code.starts_with("path.") || fault.code.starts_with("file.");
  if (!cannot_be_had) return fault;
  if (fault.message.find(fault.where) == std::string::npos) fault.message = fault.where + " " + fault.message;
  fault.where = reference.pointer;
  return fault;
}

std::vector<Reference> references_of(const Project& project) {
  std::vector<Reference> references;
  add_references(project.surfaces, "surfaces", references);
  add_references(project.objects, "objects", references);
  return references;
}

Result<Assets> read_all(const Project& project, FileSource& source) {
  Assets assets;
  for (const Reference& reference : references_of(project)) {
    if (assets.models.contains(reference.path)) continue;
    Result<MeshFile> file = read_from(source, reference.path);
    if (!file) return placed_in_project(file.fault(), reference);
    assets.models.emplace(reference.path, std::make_shared<const Model>(std::move(file->model)));
  }
  return assets;
}

}  // namespace

std::set<std::string> mesh_files(const Project& project) {
  std::set<std::string> files;
  for (Reference& reference : references_of(project)) files.insert(std::move(reference.path));
  return files;
}

Result<LoadedAssets> load_assets(const Project& project, const std::filesystem::path& folder) {
  FolderSource source(folder);
  Result<Assets> assets = read_all(project, source);
  if (!assets) return assets.fault();
  return LoadedAssets{*std::move(assets), source.take()};
}

Result<Assets> assets_from(const Project& project, const std::vector<AssetFile>& files) {
  MemorySource source(files);
  return read_all(project, source);
}

Result<ImportReport> inspect_asset(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.parent_path();
  FolderSource source(folder.empty() ? std::filesystem::path(".") : folder);
  Result<MeshFile> read = read_from(source, file.filename().string());
  if (!read) return read.fault();
  return ImportReport{read->vertices, read->triangles, std::make_shared<const Model>(std::move(read->model)),
                      std::move(read->findings)};
}

}  // namespace focalstage
