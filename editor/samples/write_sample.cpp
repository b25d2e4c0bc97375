#include <system_error>

#include "editor/samples/samples.h"
#include "io/files/files.h"

namespace focalstage {
namespace {

Status make_folder(const std::filesystem::path& folder) {
  std::error_code problem;
  if (std::filesystem::exists(folder, problem) &&
      (!std::filesystem::is_directory(folder, problem) || !std::filesystem::is_empty(folder, problem))) {
    return Fault{"project.exists", folder.string(), "is there already and not empty", "choose another name"};
  }
  std::filesystem::create_directories(folder, problem);
  if (problem) return Fault{"file.unwritable", folder.string(), problem.message(), "choose another place"};
  return {};
}

/// The sample's own NAME.focal takes the name of the new folder; all else keeps its path.
std::filesystem::path target_of(const SampleFile& file, const Sample& sample, const std::string& name) {
  const std::filesystem::path path(file.path);
  return path == std::string(sample.name) + ".focal" ? std::filesystem::path(name + ".focal") : path;
}

}  // namespace

std::string sample_names() {
  std::string names;
  for (const Sample& sample : samples()) names += (names.empty() ? "" : ", ") + std::string(sample.name);
  return names;
}

Result<Sample> sample_named(const std::string& name) {
  for (const Sample& sample : samples()) {
    if (sample.name == name) return sample;
  }
  return Fault{"sample.unknown", name, "there is no sample of that name", "choose from " + sample_names()};
}

Result<std::filesystem::path> write_sample(const Sample& sample, const std::filesystem::path& asked) {
  std::filesystem::path folder = std::filesystem::absolute(asked).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  if (const Status made = make_folder(folder); !made) return made.fault();
  const std::string name = folder.filename().string();
  for (const SampleFile& file : sample.files) {
    const std::filesystem::path target = folder / target_of(file, sample, name);
    std::error_code problem;
    std::filesystem::create_directories(target.parent_path(), problem);
    if (const Status written = write_file_atomically(target, file.bytes); !written) return written.fault();
  }
  return folder / (name + ".focal");
}

}  // namespace focalstage
