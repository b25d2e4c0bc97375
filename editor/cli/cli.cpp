#include <CLI/CLI.hpp>
#include <cctype>
#include <cstdio>
#include <string>
#include <vector>

#include "editor/cli/command.h"
#include "editor/cli/output.h"

namespace focalstage {
namespace {

constexpr const char* version = "0.1.0";

std::string help_text() {
  std::string text =
      "Focalstage shows each part of a projected picture at its own focal distance.\n\n"
      "Usage: focalstage COMMAND [ARGUMENTS]\n\nCommands:\n";
  for (const Command& command : commands()) {
    std::string name = command.name;
    name.resize(13, ' ');
    text += "  " + name + command.help + "\n";
  }
  text +=
      "\nfocalstage COMMAND --help says more; --version names this version.\n"
      "Exit status: 0 done; 1 done, but with findings of severity error; 2 wrong usage; 3 input that cannot be\n"
      "read or is invalid; 4 the environment says no (no display, no connection, disk full).\n";
  return text;
}

ExitStatus wrong_usage(const std::string& command, std::string message) {
  for (char& c : message) {
    if (c == '\n') c = ' ';
  }
  while (!message.empty() && (message.back() == ' ' || message.back() == '.')) message.pop_back();
  const std::string name = command.empty() ? "focalstage" : "focalstage " + command;
  std::fprintf(stderr, "%s: %s; see %s --help\n", name.c_str(), message.c_str(), name.c_str());
  return ExitStatus::usage;
}

ExitStatus run_command(const Command& command, std::vector<std::string> arguments) {
  std::string description = command.help;
  description.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(description.front())));
  CLI::App app{description + "."};
  app.name(std::string("focalstage ") + command.name);
  app.get_formatter()->column_width(34);
  const Command::Run run = command.declare(app);
  try {
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
    app.parse(reversed);
  } catch (const CLI::CallForHelp&) {
    std::fputs(app.help().c_str(), stdout);
    return ExitStatus::done;
  } catch (const CLI::ParseError& error) {
    return wrong_usage(command.name, error.what());
  }
  return run();
}

ExitStatus dispatch(const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    std::fputs(help_text().c_str(), stderr);
    return ExitStatus::usage;
  }
  const std::string& first = arguments.front();
  if (first == "--help" || first == "-h" || first == "help") {
    std::fputs(help_text().c_str(), stdout);
    return ExitStatus::done;
  }
  if (first == "--version") {
    std::printf("focalstage %s\n", version);
    return ExitStatus::done;
  }
  for (const Command& command : commands()) {
    if (first == command.name) return run_command(command, {arguments.begin() + 1, arguments.end()});
  }
  return wrong_usage("", "there is no command '" + first + "'");
}

}  // namespace

int run_focalstage(int argc, const char* const* argv) {
  const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  const ExitStatus status = dispatch(arguments);
  if (std::fflush(stdout) != 0) {
    std::fputs("focalstage: standard output: cannot be written; is the disk full or the pipe closed?\n", stderr);
    return static_cast<int>(ExitStatus::environment);
  }
  return static_cast<int>(status);
}

}  // namespace focalstage
