#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>

#include "editor/cli/command_list.h"
#include "editor/cli/output.h"
#include "editor/cli/rig_link.h"

namespace focalstage {
namespace {

struct Options {
  std::string action;
  std::string cue;
  std::string rig;
  std::uint64_t sweeps = 0;
  double seconds = 0.0;
  bool json = false;
};

/// A line a second until told to stop.
Status watch(RigClient& rig, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto started = Clock::now();
  return rig.watch(std::chrono::seconds(1), [&](const RigState& state) {
    std::printf("%s", state_line(state).c_str());
    std::fflush(stdout);
    return seconds <= 0.0 || std::chrono::duration<double>(Clock::now() - started).count() < seconds;
  });
}

/// Does what was asked; "state" is only the look at it that follows every action.
Status act(RigClient& rig, const Options& options) {
  if (options.action == "play") return rig.play(options.sweeps);
  if (options.action == "hold") return rig.hold();
  if (options.action == "blackout") return rig.blackout();
  if (options.action == "go") return rig.go();
  if (options.action == "cue") return rig.cue(options.cue);
  if (options.action == "next") return rig.next();
  if (options.action == "back") return rig.back();
  if (options.action == "watch") return watch(rig, options.seconds);
  return {};
}

ExitStatus run(const Options& options) {
  if ((options.action == "cue") == options.cue.empty()) {
    std::fprintf(stderr, "focalstage rig: %s; see focalstage rig --help\n",
                 options.cue.empty() ? "cue needs the NAME of a cue" : "only cue takes a NAME");
    return ExitStatus::usage;
  }
  auto rig = connect_to_rig(options.rig);
  if (!rig) return report(rig.fault());
  if (const Status acted = act(*rig, options); !acted) return report(acted.fault());
  const auto state = rig->state();
  if (!state) return report(state.fault());
  if (options.json) {
    print_json(value_of(*state));
  } else {
    std::fputs(state_text(*state).c_str(), stdout);
  }
  return ExitStatus::done;
}

}  // namespace

Command::Run declare_rig(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.add_option("ACTION", options->action,
                 "state, play, hold, blackout, go (lifts a blackout or fault), cue, next, back, watch")
      ->required()
      ->type_name("")
      ->check(CLI::IsMember({"state", "play", "hold", "blackout", "go", "cue", "next", "back", "watch"}).name(""));
  app.add_option("NAME", options->cue, "the cue to jump to")->type_name("");
  add_rig_option(app, options->rig);
  app.add_option("--sweeps", options->sweeps, "play: this many, then hold; on and on by default")->type_name("N");
  app.add_option("--seconds", options->seconds, "watch: this long; until Ctrl-C by default")->type_name("S");
  app.add_flag("--json", options->json, "print the state as one JSON object");
  return [options] { return run(*options); };
}

}  // namespace focalstage
