#include <unistd.h>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "editor/cli/command_list.h"
#include "editor/cli/output.h"

namespace focalstage {
namespace {

/// Becomes the program `name` that stands beside this one.
ExitStatus become(const std::string& name, const std::vector<std::string>& arguments) {
  std::error_code problem;
  const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", problem);
  const std::filesystem::path program = own.parent_path() / name;
  if (problem || access(program.c_str(), X_OK) != 0) {
    return report({"program.missing", program.string(), "this program is not there",
                   "build it, or install it beside focalstage"});
  }
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  return report({"program.failed", program.string(), std::generic_category().message(errno), ""});
}

Command::Run pass_on(CLI::App& app, const std::string& name) {
  app.set_help_flag();
  app.prefix_command();
  return [&app, name] { return become(name, app.remaining()); };
}

}  // namespace

Command::Run declare_runtime(CLI::App& app) { return pass_on(app, "focalstage-runtime"); }
Command::Run declare_edit(CLI::App& app) { return pass_on(app, "focalstage-editor"); }
Command::Run declare_bench(CLI::App& app) { return pass_on(app, "focalstage-bench"); }

}  // namespace focalstage
