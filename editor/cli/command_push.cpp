#include <CLI/CLI.hpp>
#include <memory>
#include <stop_token>

#include "editor/cli/command_list.h"
#include "editor/cli/interrupt.h"
#include "editor/cli/output.h"
#include "editor/cli/progress.h"
#include "editor/cli/rig_link.h"

namespace focalstage {
namespace {

struct Options {
  std::string show;
  std::string rig;
  bool activate = false;
};

/// Lets go of the rig before it returns, also after a stop: the next push need not wait for the lease to end.
Status push(const Options& options, const std::stop_token& stop) {
  auto rig = connect_to_rig(options.rig);
  if (!rig) return rig.fault();
  Progress bar("Pushing to " + options.rig, Progress::Style::automatic);
  const auto show_share = [&](double share) { bar.update(share, 1.0, ""); };
  return rig->push(options.show, options.activate, show_share, stop);
}

ExitStatus run(const Options& options) {
  Interrupt interrupt;
  const Status pushed = push(options, interrupt.token());
  if (!pushed) {
    Fault fault = pushed.fault();
    // A rig speaks of its own copy; what the user knows is the show.
    const bool of_the_rig = fault.where.find(options.show) == std::string::npos && fault.code != "rig.unreachable";
    if (of_the_rig) fault.where = options.show + ": " + fault.where;
    const ExitStatus status = report(fault);
    interrupt.end_if_asked();
    return status;
  }
  std::printf("%s: pushed to %s%s\n", options.show.c_str(), options.rig.c_str(),
              options.activate ? " and activated" : "");
  return ExitStatus::done;
}

}  // namespace

Command::Run declare_push(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("SHOW", options->show, "the show (.h5)")->required()->type_name("");
  add_rig_option(app, options->rig);
  app.add_flag("--activate", options->activate, "make it the rig's show at the next sweep");
  return [options] { return run(*options); };
}

}  // namespace focalstage
