// What travels with a project: its assets, into a folder of its own and with it to another.
#include <algorithm>
#include <system_error>

#include "core/scene/sequence.h"
#include "editor/document/document.h"
#include "editor/document/recent.h"
#include "io/assets/image_plane.h"
#include "io/files/files.h"
#include "io/models/models.h"
#include "io/project/project_file.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t largest_picture = 256u << 20;

Status write_files(const std::vector<AssetFile>& files, const fs::path& folder) {
  for (const AssetFile& file : files) {
    const fs::path target = folder / file.path;
    std::error_code problem;
    fs::create_directories(target.parent_path(), problem);
    if (Status written = write_file_atomically(target, std::span<const std::byte>(file.bytes)); !written) {
      return written;
    }
  }
  return {};
}

fs::path target_file(const fs::path& asked) {
  const fs::path path = fs::absolute(asked).lexically_normal();
  if (path.extension() == ".focal") return path;
  const fs::path folder = path.has_filename() ? path : path.parent_path();
  return folder / (folder.filename().string() + ".focal");
}

/// Every file the project is made of, as far as it can be read.
std::vector<AssetFile> files_of(const Project& project, const fs::path& folder) {
  std::vector<AssetFile> files;
  for (const AssetReference& reference : references_in(project)) {
    auto loaded = load_reference(reference, folder);
    if (!loaded) continue;
    for (AssetFile& file : loaded->files) {
      const auto same = [&](const AssetFile& other) { return other.path == file.path; };
      if (std::none_of(files.begin(), files.end(), same)) files.push_back(std::move(file));
    }
  }
  return files;
}

/// "assets/rabbit.obj", or "assets/rabbit-2.obj" where another file has that name; a set of files gets a folder.
fs::path place_for(const fs::path& folder, const std::string& name, const std::vector<AssetFile>& files) {
  const std::string stem = fs::path(name).stem().string(), extension = fs::path(name).extension().string();
  for (int k = 1;; ++k) {
    const std::string number = k == 1 ? "" : "-" + std::to_string(k);
    const bool alone = files.size() == 1;
    const fs::path place =
        alone ? fs::path("assets") / (stem + number + extension) : fs::path("assets") / (stem + number);
    std::error_code none;
    if (!fs::exists(folder / place, none)) return place;
    if (!alone) continue;
    const auto there = read_file(folder / place, files[0].bytes.size());
    if (there && files[0].bytes == *there) return place;
  }
}

/// A picture becomes a plane that carries it.
Result<std::string> bring_in_picture(const fs::path& file, const fs::path& project_folder) {
  const auto bytes = read_file(file, largest_picture);
  if (!bytes) return bytes.fault();
  auto plane = image_plane(*bytes, file);
  if (!plane) return plane.fault();
  const std::string name = file.stem().string() + ".glb";
  std::vector<AssetFile> files{{name, {}, std::move(*plane)}};
  files[0].path = place_for(project_folder, name, files).generic_string();
  if (Status written = write_files(files, project_folder); !written) return written.fault();
  return files[0].path;
}

/// The name of a file without its number, and how many digits that has.
struct NumberedName {
  std::string before;
  std::string digits;
};

NumberedName numbered_name(const fs::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t last = stem.find_last_not_of("0123456789");
  const std::size_t begin = last == std::string::npos ? 0 : last + 1;
  return {stem.substr(0, begin), stem.substr(begin)};
}

/// "fire" of fire_0001.png.
std::string series_name(const fs::path& file) {
  std::string name = numbered_name(file).before;
  while (!name.empty() && (name.back() == '_' || name.back() == '-' || name.back() == '.')) name.pop_back();
  return name.empty() ? "pictures" : name;
}

/// The picture, as the first of a sequence where it has a number and the next one is there.
ImageAppearance numbered(const fs::path& file) {
  ImageAppearance look;
  look.file = file.filename().string();
  const NumberedName name = numbered_name(file);
  if (name.digits.empty() || name.digits.size() > 9 || name.before.find('#') != std::string::npos) return look;
  ImageAppearance series = look;
  series.file = name.before + std::string(name.digits.size(), '#') + file.extension().string();
  series.first = std::stoi(name.digits);
  constexpr int most_pictures = 10'000;
  series.count = most_pictures;
  std::error_code none;
  int count = 1;
  while (count < most_pictures && fs::exists(file.parent_path() / picture_file(series, count), none)) ++count;
  series.count = count;
  return count > 1 ? series : look;
}

}  // namespace

Result<std::string> bring_in(const fs::path& file, const fs::path& project_folder) {
  if (is_picture(file)) return bring_in_picture(file, project_folder);
  const std::string name = file.filename().string();
  auto loaded = load_reference({name}, fs::absolute(file).parent_path());
  if (!loaded) {
    Fault fault = loaded.fault();
    if (fault.where.starts_with("/objects/0")) fault.where = file.string();
    return fault;
  }
  const fs::path place = place_for(project_folder, name, loaded->files);
  const bool alone = loaded->files.size() == 1;
  for (AssetFile& piece : loaded->files) piece.path = (alone ? place : place / piece.path).string();
  if (Status written = write_files(loaded->files, project_folder); !written) return written.fault();
  return (alone ? place : place / name).generic_string();
}

Result<ImageAppearance> bring_in_look(const fs::path& file, const fs::path& project_folder, double rate_hz) {
  if (!is_picture(file)) {
    return Fault{"image.unsupported", file.string(), "this is neither a PNG nor a JPEG", "export it as one of them"};
  }
  ImageAppearance look = numbered(file);
  if (look.count > 0) look.rate_hz = rate_hz;
  Project only;
  only.objects.emplace_back().appearance = look;
  auto loaded = load_assets(only, fs::absolute(file).parent_path());
  if (!loaded) return loaded.fault();
  const fs::path place = place_for(project_folder, look.count > 0 ? series_name(file) : look.file, loaded->files);
  const bool alone = loaded->files.size() == 1;
  for (AssetFile& piece : loaded->files) piece.path = (alone ? place : place / piece.path).string();
  if (Status written = write_files(loaded->files, project_folder); !written) return written.fault();
  look.file = (alone ? place : place / look.file).generic_string();
  return look;
}

Status Document::save_as(const fs::path& asked) {
  const fs::path file = target_file(asked);
  std::error_code problem;
  if (file != file_ && fs::exists(file, problem)) {
    return Fault{"project.exists", file.string(), "is there already", "choose another name, or remove it first"};
  }
  fs::create_directories(file.parent_path(), problem);
  if (problem) return Fault{"file.unwritable", file.parent_path().string(), problem.message(), "choose another place"};
  if (Status written = write_files(files_of(project(), folder()), file.parent_path()); !written) return written;
  if (Status copied = copy_models(folder(), file.parent_path()); !copied) return copied;
  if (Status saved = save_project(project(), file); !saved) return saved;
  if (file != file_) close();
  file_ = file;
  untitled_ = false;
  saved_ = history_.now();
  shelf_.move_to(folder());
  remember_disk();
  remember_recent(file_, folders_);
  return start_journal(folders_);
}

}  // namespace focalstage
