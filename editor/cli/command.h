#pragma once

#include <functional>
#include <span>

namespace CLI {
class App;
}

namespace focalstage {

/// What the shell learns (design section 3).
enum class ExitStatus {
  done = 0,
  findings = 1,     ///< done, but with findings of severity error
  usage = 2,        ///< wrong usage
  invalid = 3,      ///< input that cannot be read or is invalid
  environment = 4,  ///< no display, no connection, disk full
};

/// One command of `focalstage`: its name, what it does in a line, its options and what they start.
struct Command {
  using Run = std::function<ExitStatus()>;

  const char* name;
  const char* help;
  Run (*declare)(CLI::App& app);  ///< adds the options to `app`; the result runs once they are parsed
};

/// All commands in the order of the help. The one list: parsing, help and the README's test read it.
std::span<const Command> commands();

/// The program: parses, runs, and returns the exit status.
int run_focalstage(int argc, const char* const* argv);

}  // namespace focalstage
