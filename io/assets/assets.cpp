#include "io/assets/assets.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "core/scene/sequence.h"
#include "io/assets/file_source.h"
#include "io/assets/mesh_file.h"
#include "io/assets/picture_file.h"

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

/// Calls `use(image, pointer)` for every object that looks like a picture, and every surface whose paint is one, and
/// stops at a fault.
template <class Use>
Status each_image(const Project& project, Use&& use) {
  for (std::size_t i = 0; i < project.objects.size(); ++i) {
    const auto* image = std::get_if<ImageAppearance>(&project.objects[i].appearance);
    if (image == nullptr) continue;
    Status used = use(*image, "/objects/" + std::to_string(i) + "/appearance/image/file");
    if (!used) return used;
  }
  for (std::size_t i = 0; i < project.surfaces.size(); ++i) {
    const auto* paint = std::get_if<FileAlbedo>(&project.surfaces[i].albedo);
    if (paint == nullptr) continue;
    ImageAppearance image;
    image.file = paint->file;
    Status used = use(image, "/surfaces/" + std::to_string(i) + "/albedo/file");
    if (!used) return used;
  }
  return {};
}

int pictures_in(const ImageAppearance& image) { return image.count > 0 ? image.count : 1; }

std::string size_words(const PictureFile& picture) {
  return std::to_string(picture.width_px) + " x " + std::to_string(picture.height_px) + " pixels";
}

/// Reads pictures one after another, and how much there was of them.
class PictureReader {
 public:
  PictureReader(FileSource& source, Assets& assets) : source_(source), assets_(assets) {}

  Status read(const ImageAppearance& image, const std::string& pointer) {
    std::optional<PictureFile> first;
    for (int index = 0; index < pictures_in(image); ++index) {
      const std::string path = picture_file(image, index);
      Result<PictureFile> picture = one(path);
      if (!picture) return fault_of(picture.fault(), image, index, pointer);
      if (first && (first->width_px != picture->width_px || first->height_px != picture->height_px)) {
        return Fault{"asset.sequence", pointer,
                     path + " has " + size_words(*picture) + ", " + picture_file(image, 0) + " " + size_words(*first),
                     "make all pictures of a sequence the same size"};
      }
      if (!first) first = *picture;
      assets_.pictures.insert_or_assign(path, picture->picture);
    }
    return {};
  }

 private:
  Result<PictureFile> one(const std::string& path) {
    const auto known = read_.find(path);
    if (known != read_.end()) return known->second;
    const Result<const AssetFile*> file = source_.file(path);
    if (!file) return file.fault();
    bytes_ += (*file)->bytes.size();
    if (bytes_ > most_picture_bytes) {
      return Fault{"asset.too-large", path, "the pictures of the project have more than 512 MiB together",
                   "make them smaller, or fewer"};
    }
    AssetFile named = **file;
    named.path = path;
    Result<PictureFile> picture = open_picture(named);
    if (picture) read_.emplace(path, *picture);
    return picture;
  }

  static Fault fault_of(Fault fault, const ImageAppearance& image, int index, const std::string& pointer) {
    if (fault.message.find(fault.where) == std::string::npos) fault.message = fault.where + ": " + fault.message;
    if (image.count > 0) {
      fault.message += ", picture " + std::to_string(index + 1) + " of " + std::to_string(image.count);
    }
    fault.where = pointer;
    return fault;
  }

  FileSource& source_;
  Assets& assets_;
  std::map<std::string, PictureFile> read_;
  std::uint64_t bytes_ = 0;
};

Result<Assets> read_all(const Project& project, FileSource& source) {
  Assets assets;
  for (const Reference& reference : references_of(project)) {
    if (assets.models.contains(reference.path)) continue;
    Result<MeshFile> file = read_from(source, reference.path);
    if (!file) return placed_in_project(file.fault(), reference);
    assets.models.emplace(reference.path, std::make_shared<const Model>(std::move(file->model)));
  }
  PictureReader pictures(source, assets);
  const Status read = each_image(
      project, [&](const ImageAppearance& image, const std::string& pointer) { return pictures.read(image, pointer); });
  if (!read) return read.fault();
  return assets;
}

}  // namespace

std::set<std::string> asset_files(const Project& project) {
  std::set<std::string> files;
  for (Reference& reference : references_of(project)) files.insert(std::move(reference.path));
  (void)each_image(project, [&](const ImageAppearance& image, const std::string&) -> Status {
    for (int index = 0; index < pictures_in(image); ++index) files.insert(picture_file(image, index));
    return {};
  });
  return files;
}

bool has_all(const Assets& assets, const Project& project) {
  const auto known = [&](const std::string& file) {
    return assets.models.contains(file) || assets.pictures.contains(file);
  };
  const std::set<std::string> files = asset_files(project);
  return std::all_of(files.begin(), files.end(), known);
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
