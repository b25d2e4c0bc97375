#include "io/models/models.h"

#include <algorithm>
#include <system_error>
#include <utility>
#include <vector>

#include "io/files/files.h"
#include "io/models/shipped.h"

namespace focalstage {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t size_limit = 1u << 20;

/// The *.json of a folder, sorted; none where there is no folder.
Result<std::vector<fs::path>> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  if (!fs::exists(folder, error) && !error) return files;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (at->path().extension() == ".json") files.push_back(at->path());
  }
  if (error) {
    return Fault{"file.unreadable", folder.string(), "cannot be read: " + error.message(),
                 "make it a folder that can be read, or remove it"};
  }
  std::sort(files.begin(), files.end());
  return files;
}

Result<ProjectorModelData> model_from(const fs::path& file) {
  const auto bytes = read_file(file, size_limit);
  if (!bytes) return bytes.fault();
  return parse_model({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, file.string());
}

/// Adds `more`, each in the place of an earlier one of its name.
void take_over(ProjectorModels& models, ProjectorModels more) {
  for (ProjectorModelData& model : more) {
    const auto same = [&](const ProjectorModelData& known) { return known.name == model.name; };
    const auto known = std::find_if(models.begin(), models.end(), same);
    if (known == models.end()) {
      models.push_back(std::move(model));
    } else {
      *known = std::move(model);
    }
  }
}

}  // namespace

Result<ProjectorModels> shipped_models() {
  ProjectorModels models;
  for (const ShippedModel& shipped : shipped_files()) {
    auto model = parse_model(shipped.text, std::string(shipped.file));
    if (!model) return model.fault();
    models.push_back(*std::move(model));
  }
  return models;
}

Result<ProjectorModels> models_in(const fs::path& folder) {
  const auto files = files_in(folder);
  if (!files) return files.fault();
  ProjectorModels models;
  for (const fs::path& file : *files) {
    auto model = model_from(file);
    if (!model) return model.fault();
    if (const ProjectorModelData* twin = find_model(models, model->name); twin != nullptr) {
      return Fault{"model.twice", file.string() + ": /name",
                   "another file of this folder describes \"" + model->name + "\" already",
                   "rename the model, or remove one of the files"};
    }
    models.push_back(*std::move(model));
  }
  return models;
}

Result<ProjectorModels> known_models(const fs::path& project_folder, const fs::path& user_folder) {
  auto models = shipped_models();
  if (!models) return models;
  std::vector<fs::path> folders{user_folder / models_folder_name};
  if (!project_folder.empty()) folders.push_back(project_folder / models_folder_name);
  for (const fs::path& folder : folders) {
    auto more = models_in(folder);
    if (!more) return more;
    take_over(*models, *std::move(more));
  }
  return models;
}

Status copy_models(const fs::path& from_folder, const fs::path& to_folder) {
  const auto files = files_in(from_folder / models_folder_name);
  if (!files) return files.fault();
  for (const fs::path& file : *files) {
    const fs::path target = to_folder / models_folder_name / file.filename();
    std::error_code problem;
    if (fs::exists(target, problem)) continue;
    const auto bytes = read_file(file, size_limit);
    if (!bytes) return bytes.fault();
    fs::create_directories(target.parent_path(), problem);
    if (Status written = write_file_atomically(target, std::span<const std::byte>(*bytes)); !written) return written;
  }
  return {};
}

}  // namespace focalstage
