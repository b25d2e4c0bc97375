#include <CLI/CLI.hpp>
#include <memory>

#include "editor/cli/command_list.h"
#include "editor/cli/output.h"
#include "editor/samples/samples.h"

namespace focalstage {
namespace {

struct Options {
  std::string folder;
  std::string from = "first-light";
};

ExitStatus run(const Options& options) {
  const auto sample = sample_named(options.from);
  if (!sample) {
    Fault fault = sample.fault();
    fault.where = "--from " + fault.where;
    report(fault);
    return ExitStatus::usage;
  }
  const auto made = write_sample(*sample, options.folder);
  if (!made) return report(made.fault());
  const std::filesystem::path shown = std::filesystem::path(options.folder) / made->filename();
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
