#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <system_error>

#include "editor/cli/command_list.h"
#include "editor/cli/output.h"
#include "editor/cli/samples.h"
#include "io/files/files.h"

namespace focalstage {
namespace {

struct Options {
  std::string folder;
  std::string from = "first-light";
};

std::string sample_names() {
  std::string names;
  for (const Sample& sample : samples()) names += (names.empty() ? "" : ", ") + std::string(sample.name);
  return names;
}

Result<Sample> sample_named(const std::string& name) {
  for (const Sample& sample : samples()) {
    if (sample.name == name) return sample;
  }
  return Fault{"sample.unknown", "--from " + name, "there is no sample of that name", "choose from " + sample_names()};
}

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

ExitStatus run(const Options& options) {
  const auto sample = sample_named(options.from);
  if (!sample) {
    report(sample.fault());
    return ExitStatus::usage;
  }
  std::filesystem::path folder = std::filesystem::absolute(options.folder).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  if (const Status made = make_folder(folder); !made) return report(made.fault());
  const std::string name = folder.filename().string();
  for (const SampleFile& file : sample->files) {
    const std::filesystem::path target = folder / target_of(file, *sample, name);
    std::error_code problem;
    std::filesystem::create_directories(target.parent_path(), problem);
    if (const Status written = write_file_atomically(target, file.bytes); !written) return report(written.fault());
  }
  const std::filesystem::path shown = std::filesystem::path(options.folder) / (name + ".focal");
  std::printf("%s: made from %s\n", shown.lexically_normal().c_str(), options.from.c_str());
  return ExitStatus::done;
}

}  // namespace

Command::Run declare_new(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("DIR", options->folder, "the folder to make; its name becomes the project file's")->required();
  app.add_option("--from", options->from, "the sample to start from: " + sample_names())
      ->type_name("NAME")
      ->capture_default_str();
  return [options] { return run(*options); };
}

}  // namespace focalstage
