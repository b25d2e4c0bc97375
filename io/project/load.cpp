#include "core/scene/project_value.h"
#include "io/files/files.h"
#include "io/json/json.h"
#include "io/project/project_file.h"
#include "io/project/schemas.h"
#include "io/project/validate.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view suffix = ".focal";

Fault not_a_project(const fs::path& path, std::string message) {
  return {"project.missing", path.string(), std::move(message), "name a NAME.focal, or the folder that holds one"};
}

/// NAME/NAME.focal, or the only *.focal of the folder.
Result<fs::path> file_in_folder(const fs::path& folder) {
  std::error_code error;
  const fs::path named = folder / (fs::canonical(folder, error).filename().string() + std::string(suffix));
  if (!error && fs::is_regular_file(named, error)) return named;
  std::vector<fs::path> found;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code unreadable;
    if (at->path().extension() == suffix && at->is_regular_file(unreadable)) found.push_back(at->path());
  }
  if (error) return Fault{"file.unreadable", folder.string(), "cannot be read: " + error.message(), ""};
  if (found.size() == 1) return found.front();
  return not_a_project(
      folder, found.empty() ? "holds no *.focal file" : "holds several *.focal files, none named after the folder");
}

}  // namespace

Result<fs::path> project_file(const fs::path& project) {
  std::error_code error;
  const fs::file_status status = fs::status(project, error);
  if (!fs::exists(status)) {
    return Fault{"file.missing", project.string(), "there is no such file or folder", "check the path"};
  }
  if (fs::is_directory(status)) return file_in_folder(project);
  if (project.extension() != suffix) return not_a_project(project, "is no *.focal file");
  return project;
}

Result<LoadedProject> parse_project(std::string_view text, const std::string& source) {
  const auto value = parse_json(text, source);
  if (!value) return value.fault();
  LoadedProject loaded;
  auto project = project_from(*value, &loaded.notes);
  if (!project) return in_file(project.fault(), source);
  // The schema is what the world was promised: what it refuses is no project, whatever our own reader makes of it. It
  // comes second because the reader says more plainly what is wrong.
  if (const auto refused = schema_fault(*value, project_schema())) return in_file(*refused, source);
  loaded.project = std::move(*project);
  loaded.text = text;
  return loaded;
}

Result<LoadedProject> load_project(const fs::path& project) {
  const auto file = project_file(project);
  if (!file) return file.fault();
  const auto bytes = read_file(*file, JsonLimits{}.bytes);
  if (!bytes) return bytes.fault();
  auto loaded = parse_project({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, file->string());
  if (loaded) loaded->file = *file;
  return loaded;
}

}  // namespace focalstage
